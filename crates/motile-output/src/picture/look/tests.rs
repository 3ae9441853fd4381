use super::*;
use crate::drawing::raster::colours;
use crate::{DropletOutline, InteriorField, Raster, Rgb, SolidShape};
use motile::base::FlowSample;

const STILL: Format =
    Format { width: 1200.0, em: 21.0, per_cm: None, levels: 256, streamline_spacing: 1.0, follows: true };

/// A pressure that is 0 in the left and 1 in the right half of a square box around the origin, without flow.
fn halves() -> Snapshot {
    let raster = Raster::new([-3.0, -3.0], [6.0, 6.0], [60, 60], [true, true]).unwrap();
    let sample = |p: &Vec2| FlowSample { pressure: if p.x < 0.0 { 0.0 } else { 1.0 }, ..FlowSample::default() };
    let flow = raster.points().iter().map(sample).collect();
    Snapshot {
        time: 0.0,
        raster,
        flow,
        interfaces: Vec::new(),
        droplets: Vec::new(),
        gels: Vec::new(),
        inside: Vec::new(),
        solids: Vec::new(),
        walls: None,
        smear: 0.0,
        origin: String::new(),
    }
}

fn circle(x: f64) -> DropletOutline {
    let angles = (0..90).map(|k| f64::from(k) * 4f64.to_radians());
    let markers = angles.map(|t| Vec2::new(x + t.cos(), t.sin())).collect();
    DropletOutline { markers, concentration: vec![0.5; 90], centroid: Vec2::new(x, 0.0) }
}

fn draw(seen: &Snapshot, tracks: &[Track], format: &Format) -> Vec<Rgb> {
    let look = Look::default();
    let drawing = look.draw(seen, &look.legends(std::slice::from_ref(seen)), tracks, format).unwrap();
    colours(&drawing.pixels(1.0).unwrap()).collect()
}

fn count(image: &[Rgb], colour: Rgb) -> f64 {
    image.iter().filter(|&&p| p == colour).count() as f64
}

#[test]
fn the_pressure_fills_its_halves() {
    let seen = halves();
    let scale = Look::default().legends(std::slice::from_ref(&seen)).pressure;
    let image = draw(&seen, &[], &Format::FRAME);
    let (left, right) = (count(&image, scale.colour(0.0)), count(&image, scale.colour(1.0)));
    assert!(left > 40_000.0 && (left / right - 1.0).abs() < 0.1, "{left} {right}");
}

#[test]
fn droplets_across_the_border_show_on_both_sides_and_all_of_them_show() {
    let format = Format { width: 800.0, em: 21.6, ..Format::FRAME };
    let ink = |droplets: &[f64]| {
        let droplets = droplets.iter().map(|&x| circle(x)).collect();
        let seen = Snapshot { droplets, ..halves() };
        let scale = Look::default().legends(std::slice::from_ref(&seen)).concentration.expect("a scale");
        count(&draw(&seen, &[], &format), scale.colour(0.5))
    };
    // Without droplets there is no legend for them either.
    let (inside, across, far) = (ink(&[1.5]), ink(&[3.0]), ink(&[3.0 - 60.0]));
    assert!((across / inside - 1.0).abs() < 0.05, "{across} {inside}");
    assert!((far / across - 1.0).abs() < 1e-3, "{far} {across}");
    let (two, three) = (ink(&[-1.5, 1.5]), ink(&[-1.5, 1.5, 4.5]));
    let one = two - inside;
    assert!(one > 300.0, "{two} {inside}");
    // The third is on the first.
    assert!((three / two - 1.0).abs() < 1e-3, "{three} {two}");
}

#[test]
fn a_single_droplet_is_in_the_middle_of_a_still() {
    let seen = Snapshot { droplets: vec![circle(2.0)], ..halves() };
    let image = draw(&seen, &[], &STILL);
    let other = draw(&Snapshot { droplets: vec![circle(2.0), circle(2.0)], ..halves() }, &[], &STILL);
    assert_ne!(image, other);
}

#[test]
fn values_that_are_not_numbers_do_no_harm() {
    let raster = Raster::new([0.0, 0.0], [4.0, 2.0], [8, 4], [true, false]).unwrap();
    let bad = Vec2::new(f64::NAN, 1.0);
    let flow = vec![FlowSample { velocity: bad, pressure: f64::NAN, ..FlowSample::default() }; 32];
    let droplets = vec![DropletOutline { markers: vec![bad; 3], concentration: vec![f64::NAN; 3], centroid: bad }];
    let solids = vec![SolidShape {
        area: vec![vec![bad; 3]],
        edges: vec![vec![bad; 3], Vec::new()],
        triangles: vec![[bad; 3]],
        displacement: vec![f64::NAN],
        stress: vec![f64::NAN],
        internal_stress: vec![f64::NAN],
        bonds: vec![vec![bad; 2]],
        holds_fluid: false,
    }];
    let seen = Snapshot {
        time: 1.0,
        raster,
        flow,
        droplets,
        interfaces: Vec::new(),
        gels: Vec::new(),
        inside: Vec::new(),
        solids,
        walls: Some([0.0, 2.0]),
        smear: 0.1,
        origin: String::new(),
    };
    draw(&seen, &[vec![(0.0, bad), (0.5, Vec2::new(1.0, 1.0))], Vec::new()], &STILL);
    let look = Look::default();
    let short = Snapshot { flow: Vec::new(), ..seen };
    let drawn = look.draw(&short, &look.legends(&[]), &[], &Format::FRAME);
    assert!(matches!(drawn, Err(OutputError::Count { given: 0, expected: 32, .. })));
}

#[test]
fn paths_end_with_the_state_and_are_shorter_than_the_period() {
    let path: Vec<Vec2> = (0..100).map(|k| Vec2::new(0.1 * f64::from(k), 0.0)).collect();
    let end = last_period(&path, 4.0);
    assert!((end[0].x - 6.9).abs() < 1e-9 && end.last() == path.last());
    assert!(last_period(&[], 1.0).is_empty());
}

#[test]
fn the_field_inside_is_as_bright_as_it_is_dense() {
    let corner = |x: f64, y: f64| Vec2::new(x, y);
    let triangle = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(0.0, 2.0)];
    let field = |densities| InteriorField { triangles: vec![triangle], densities: vec![densities] };
    let seen = |densities| Snapshot { inside: vec![field(densities)], ..halves() };
    let legends = Look::default().legends(&[seen([0.0, 4.0, 2.0])]);
    let scale = legends.inside.as_ref().expect("a scale");
    assert_eq!([scale.low, scale.high], [0.0, 4.0]);
    let image = |seen: &Snapshot| {
        let drawing = Look::default().draw(seen, &legends, &[], &Format::FRAME).unwrap();
        colours(&drawing.pixels(1.0).unwrap()).collect::<Vec<Rgb>>()
    };
    // Three of 36 squares of the frame's area, which is the share of the pressure that it hides; the colour bar has a
    // few pixels of each colour.
    let uniform = image(&seen([1.0; 3]));
    let (inside, left) = (count(&uniform, scale.colour(1.0)), count(&uniform, legends.pressure.colour(0.0)));
    assert!((inside / left - 3.0 / 16.5).abs() < 0.01, "{inside} {left}");
    let graded = image(&seen([0.0, 4.0, 2.0]));
    // The mean of each of the sixteen parts: no two neighbours of one colour, none of the ends.
    assert!(count(&graded, scale.colour(2.0)) > 0.04 * inside, "{}", count(&graded, scale.colour(2.0)));
    assert!(count(&graded, scale.colour(1.0)) < 0.3 * inside);
    assert!(Look::default().legends(&[halves()]).inside.is_none());
}

/// A jump of the pressure that the samples smear is sharp along the interface: no colours between those of both sides.
#[test]
fn the_pressure_has_no_steps_along_an_interface() {
    let raster = Raster::new([-3.0, -3.0], [6.0, 6.0], [60, 60], [true; 2]).unwrap();
    let smeared = |p: &Vec2| -10.0 * ((p.length() - 1.0) / 0.2).clamp(-1.0, 1.0);
    let sample = |p: &Vec2| FlowSample { pressure: smeared(p), ..FlowSample::default() };
    let flow = raster.points().iter().map(sample).collect();
    let seen = Snapshot { raster, flow, droplets: vec![circle(0.0)], smear: 0.25, ..halves() };
    let look = Look { colour_bars: false, ..Look::default() };
    let legends = look.legends(std::slice::from_ref(&seen));
    let drawing = look.draw(&seen, &legends, &[], &STILL).unwrap();
    let image: Vec<Rgb> = colours(&drawing.pixels(1.0).unwrap()).collect();
    let table = legends.pressure.table(256);
    let [outside, inside] = [table[0], table[255]].map(|colour| count(&image, colour));
    assert!(
        (inside / outside - std::f64::consts::PI / (36.0 - std::f64::consts::PI)).abs() < 0.02,
        "{inside} {outside}"
    );
    let between: f64 = table[20..110].iter().chain(&table[146..236]).map(|&colour| count(&image, colour)).sum();
    // Some mixtures of lines and type with the paper look alike.
    assert!(between < 300.0, "{between}");
}

/// Widths of the lines around droplets, which are in proportion to their diameters on the page.
#[test]
fn small_droplets_have_thin_lines() {
    let widths = |side: f64| {
        let raster = Raster::new([-0.5 * side; 2], [side; 2], [60, 60], [true; 2]).unwrap();
        let seen = Snapshot { raster, droplets: vec![circle(0.0), circle(2.5)], ..halves() };
        let drawing = Look::default().draw(&seen, &Look::default().legends(&[]), &[], &STILL).unwrap().svg();
        let ink = drawing.split("stroke=\"#22262e\" stroke-width=\"").skip(1);
        let all = ink.map(|rest| rest.split('"').next().and_then(|width| width.parse().ok()).expect("a width"));
        all.collect::<Vec<f64>>()
    };
    let widest = |side: f64| {
        let all = widths(side);
        let scale_bar = 0.2 * STILL.em;
        all.into_iter().filter(|width| (width - scale_bar).abs() > 0.02).fold(0.0, f64::max)
    };
    let (large, small) = (widest(15.0), widest(30.0));
    assert!((large / small - 2.0).abs() < 0.05, "{large} {small}");
    assert!((widest(6.0) - 0.56 * STILL.em).abs() < 0.02, "{}", widest(6.0));
}

#[test]
fn sizes_and_ranges_that_cannot_be_are_refused() {
    let refused = |look: Look| look.write_picture(&halves(), &[], "/nowhere/none.png").unwrap_err().to_string();
    for (look, words) in [
        (Look { width: 0.0, ..Look::default() }, "width (cm)"),
        (Look { font_size: f64::NAN, ..Look::default() }, "size (pt)"),
        (Look { resolution: 1e5, ..Look::default() }, "resolution (pixels per cm)"),
        (Look { pressure_range: Some([1.0, 1.0]), ..Look::default() }, "colours cannot range from 1 to 1"),
        (Look { pressure_range: Some([0.0, f64::INFINITY]), ..Look::default() }, "Use two finite numbers"),
    ] {
        let told = refused(look);
        assert!(told.contains(words), "{told}");
    }
}
