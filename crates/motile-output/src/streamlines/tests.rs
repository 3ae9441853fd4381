use super::*;

fn sampled(periodic: bool, flow: impl Fn(Vec2) -> Vec2) -> Samples<Vec2> {
    let raster = Raster::new([-1.0, -1.0], [2.0, 2.0], [96, 96], [periodic; 2]).unwrap();
    Samples::new(raster, raster.points().into_iter().map(flow).collect()).unwrap()
}

#[test]
fn lines_of_a_rotation_are_circles_at_the_spacing() {
    let field = sampled(false, |p| Vec2::new(-p.y, p.x));
    let lines = streamlines(&field, 0.2, Vec2::new(0.3, 0.0)).unwrap();
    for line in &lines {
        let radius = line[0].length();
        assert!(line.iter().all(|p| (p.length() - radius).abs() < 2e-3), "a line leaves its circle of {radius}");
    }
    // The radii from the anchor outwards, as closed lines.
    for expected in [0.3, 0.5, 0.7, 0.9] {
        let line = lines.iter().find(|l| (l[0].length() - expected).abs() < 2e-3);
        assert!(line.is_some_and(|l| l[0] == l[l.len() - 1]), "the line at {expected} is not closed");
    }
}

#[test]
fn lines_keep_apart_and_fill_a_periodic_box() {
    let pi = std::f64::consts::PI;
    let field = sampled(true, |p| Vec2::new((pi * p.y).sin(), (pi * p.x).sin()));
    let spacing = 0.15;
    let lines = streamlines(&field, spacing, Vec2::ZERO).unwrap();
    let near = Neighbourhood::new(&field.raster, spacing);
    for (k, a) in lines.iter().enumerate() {
        for b in &lines[k + 1..] {
            let closest = a
                .iter()
                .flat_map(|&p| b.iter().map(move |&q| (p, q)))
                .map(|(p, q)| (near.nearest_image(p, q) - q).length())
                .fold(f64::INFINITY, f64::min);
            assert!(closest >= NEAREST_OTHER * spacing * 0.999, "{closest}");
        }
    }
    // Nowhere is there room for a circle much wider than the spacing.
    let mut filled = Neighbourhood::new(&field.raster, 2.5 * spacing);
    filled.kept.push(true);
    lines.iter().flatten().for_each(|&p| filled.add(p, 0));
    let gaps = field.raster.points().into_iter().filter(|&p| !filled.any(p, 2.0 * spacing, |_| true)).count();
    assert_eq!(gaps, 0);
}

/// Lines of a uniform flow along no axis start beside each other: the distances of the long ones from the anchor are
/// multiples of that of seeds, which no lattice of seeds has.
#[test]
fn lines_start_beside_others() {
    let along = Vec2::from_angle(0.4);
    let (spacing, anchor) = (0.13, Vec2::new(0.11, -0.07));
    let lines = streamlines(&sampled(false, |_| along), spacing, anchor).unwrap();
    let long: Vec<_> = lines.iter().filter(|line| line[0].distance(line[line.len() - 1]) > 8.0 * spacing).collect();
    assert!(long.len() > 12, "{}", long.len());
    let mut numbers = Vec::new();
    for line in long {
        let number = along.perp_dot(line[0] - anchor) / (1.001 * spacing);
        assert!((number - number.round()).abs() < 1e-3, "{number}");
        numbers.push(number.round() as i64);
    }
    numbers.sort_unstable();
    assert!(numbers.windows(2).all(|pair| pair[1] == pair[0] + 1), "{numbers:?}");
}

#[test]
fn a_fluid_at_rest_has_no_streamlines_and_a_bad_spacing_is_refused() {
    let field = sampled(true, |_| Vec2::ZERO);
    assert!(streamlines(&field, 0.1, Vec2::ZERO).unwrap().is_empty());
    for spacing in [0.0, -1.0, f64::NAN, 1e-9] {
        assert!(streamlines(&field, spacing, Vec2::ZERO).is_err());
    }
}

/// Each streamline of a flow with mirror lines has its image among the others, and lines keep apart.
#[test]
fn streamlines_have_the_mirror_lines_of_the_flow() {
    let pi = std::f64::consts::PI;
    // A swimmer's flow along x in a box, its axis off the middle; and a strain, whose lines cross none of its axes.
    let swimmer = sampled(true, |p| {
        let (x, y) = (pi * p.x, pi * (p.y - 0.13));
        Vec2::new(y.cos() * (1.0 + 0.5 * x.sin()), 0.4 * y.sin() * (x.cos() + 0.6 * (2.0 * x).sin()))
    });
    let strain = sampled(false, |p| Vec2::new(p.x, -p.y));
    for (field, anchor, axes) in [(swimmer, Vec2::new(0.2, 0.13), vec![1]), (strain, Vec2::ZERO, vec![0, 1])] {
        let spacing = 0.11;
        let lines = streamlines(&field, spacing, anchor).unwrap();
        let near = Neighbourhood::new(&field.raster, spacing);
        for &axis in &axes {
            for line in &lines {
                let reflect = |mut p: Vec2| {
                    p[axis] = 2.0 * anchor[axis] - p[axis];
                    p
                };
                let image: Vec<Vec2> = line.iter().map(|&p| reflect(p)).collect();
                let same = |other: &&Vec<Vec2>| {
                    other.len() == image.len()
                        && other.iter().zip(&image).all(|(&p, &q)| (near.nearest_image(p, q) - q).length() < 1e-9)
                };
                assert!(lines.iter().any(|other| same(&other)), "axis {axis}: the line from {} has no image", line[0]);
            }
        }
        let ends = |k: usize| lines[k].iter().copied().step_by(4);
        for (a, b) in (0..lines.len()).flat_map(|a| (0..a).map(move |b| (a, b))) {
            let gap = ends(a)
                .flat_map(|p| ends(b).map(move |q| (p, q)))
                .map(|(p, q)| (near.nearest_image(p, q) - q).length());
            assert!(gap.fold(f64::INFINITY, f64::min) > 0.3 * spacing, "{} {}", lines[a][0], lines[b][0]);
        }
        // They fill the picture.
        let total: f64 = lines.iter().flat_map(|l| l.windows(2)).map(|w| (w[1] - w[0]).length()).sum();
        assert!(total * spacing > 0.6 * 4.0 && total * spacing < 1.6 * 4.0, "{total}");
    }
}

/// Beside a mirror line a line begins no nearer to its image than to any other line.
#[test]
fn seeds_keep_apart_from_their_images() {
    let field = sampled(false, |p| Vec2::new(p.x, -p.y));
    for (x, begins) in [(0.0, true), (0.04, false), (0.06, true)] {
        let (near, mirrors) = (Neighbourhood::new(&field.raster, 0.1), Mirrors::of(&field, Vec2::ZERO, 0.1));
        let mut tracer = Tracer { field: &field, spacing: 0.1, slowest: 1e-4, near, mirrors };
        assert_eq!(tracer.line(Vec2::new(x, 0.3)).is_some(), begins, "{x}");
    }
}

/// A million cells of the spacing in a square of two by two, at a spacing of 0.002.
#[test]
fn spacings_for_too_many_streamlines_are_refused() {
    let field = sampled(true, |_| Vec2::ZERO);
    assert!(streamlines(&field, 0.00201, Vec2::ZERO).is_ok() && streamlines(&field, 0.00199, Vec2::ZERO).is_err());
}
