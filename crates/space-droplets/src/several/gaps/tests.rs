use crate::{ContractileTension, ExcludedVolume, PeriodicBox, Slit, SpaceDroplet, SpaceDroplets, Tube};

/// Convex body: an ellipsoid, by the columns of its matrix times their semi-axes, at a place.
#[derive(Clone, Copy)]
struct Ellipsoid {
    columns: [[f64; 3]; 3],
    place: [f64; 3],
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl Ellipsoid {
    /// Semi-axes, turned first about z and then about x, so that no point of a grid is where gaps are smallest.
    fn new(semi_axes: [f64; 3], [about_z, about_x]: [f64; 2], place: [f64; 3]) -> Self {
        let ((s, c), (t, d)) = (about_z.sin_cos(), about_x.sin_cos());
        let columns = [[c, d * s, t * s], [-s, d * c, t * c], [0.0, -t, d]];
        let columns = std::array::from_fn(|k| columns[k].map(|x| semi_axes[k] * x));
        Self { columns, place }
    }

    fn droplet(self, degree: usize) -> SpaceDroplet {
        let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0).unwrap();
        let shape = |s: [f64; 3]| std::array::from_fn(|i| (0..3).map(|k| s[k] * self.columns[k][i]).sum());
        SpaceDroplet::shaped(degree, shape, [1.0, 1.0], law).unwrap().with_position(self.place).unwrap()
    }

    /// Farthest extent from the centre along a unit vector.
    fn extent(self, along: [f64; 3]) -> f64 {
        self.columns.iter().map(|column| dot(*column, along).powi(2)).sum::<f64>().sqrt()
    }

    /// Gap to another body that does not overlap: the widest slab that fits between, over all directions.
    fn gap(self, other: Self) -> f64 {
        let between: [f64; 3] = std::array::from_fn(|i| other.place[i] - self.place[i]);
        let slab = |u: [f64; 3]| {
            let norm = dot(u, u).sqrt();
            let u = u.map(|x| x / norm);
            dot(u, between) - self.extent(u) - other.extent(u)
        };
        // A pattern search from the direction between the centres.
        let (mut u, mut step) = (between.map(|x| x / dot(between, between).sqrt()), 0.3);
        let mut best = slab(u);
        while step > 1e-10 {
            let sides = (0..6).map(|k| {
                let mut v = u;
                v[k / 2] += if k % 2 == 0 { step } else { -step };
                (slab(v), v)
            });
            match sides.filter(|(value, _)| *value > best).max_by(|a, b| a.0.total_cmp(&b.0)) {
                Some((value, v)) => (best, u) = (value, v),
                None => step *= 0.5,
            }
        }
        best
    }
}

const AXES: [f64; 3] = [1.25, 0.9, 0.8];

/// Ellipsoids that touch almost, are far, and have different degrees, in two units of length.
#[test]
fn gaps_of_ellipsoids_are_exact() {
    for unit in [1.0, 1e-6] {
        let scaled = |list: [f64; 3]| list.map(|x| unit * x);
        let one = Ellipsoid::new(scaled(AXES), [0.4, 0.9], [0.0; 3]);
        for place in [[2.15, 0.7, 0.6], [2.4, -1.3, 0.3], [0.3, 4.0, -3.0], [30.0, 20.0, 10.0]] {
            let other = Ellipsoid::new(scaled([0.7, 1.1, 1.0]), [1.3, 0.2], scaled(place));
            let exact = one.gap(other);
            for degrees in [[6, 9], [9, 6], [16, 4]] {
                let mut pair = SpaceDroplets::new(vec![one.droplet(degrees[0]), other.droplet(degrees[1])]).unwrap();
                for (first, second) in [(0, 1), (1, 0)] {
                    let error = pair.gap(first, second).unwrap() - exact;
                    assert!(error.abs() < 1e-9 * unit.max(exact), "{degrees:?} at {place:?}: {error:.1e} of {exact}");
                }
            }
        }
    }
}

/// A turned ellipsoid between walls, in a tube, and next to its own images.
#[test]
fn gaps_to_walls_and_images_are_exact() {
    let place = [0.13, -0.06, 0.04];
    let body = Ellipsoid::new(AXES, [0.4, 0.9], place);
    let alone = |degree: usize| SpaceDroplets::new(vec![body.droplet(degree)]).unwrap();
    let check = |mut all: SpaceDroplets, exact: f64, what: &str| {
        all.evaluate().unwrap();
        let found = all.smallest_gap(0).unwrap().unwrap();
        assert!((found - exact).abs() < 1e-9, "{what}: {found} {exact}");
    };
    let high = body.extent([0.0, 0.0, 1.0]);
    // The largest distance from the axis is the largest extent of the projection, over all directions across the axis.
    let across = |angle: f64| {
        let u = [angle.cos(), angle.sin(), 0.0];
        body.extent(u) + dot(u, place)
    };
    let widest = (0..400_000).map(|k| across(f64::from(k) * std::f64::consts::TAU * 2.5e-6)).fold(0.0, f64::max);
    for degree in [4, 9] {
        for (below, above) in [(0.4, 0.6), (0.55, 0.5), (0.45, 0.45)] {
            let slit = Slit::new(place[2] - high - below, place[2] + high + above).unwrap();
            check(alone(degree).with_surroundings(slit).unwrap(), below.min(above), "slit");
        }
        let tube = Tube::new(widest + 0.5).unwrap();
        check(alone(degree).with_surroundings(tube).unwrap(), 0.5, "tube");
        let lengths = [3.6, 3.1, 3.3];
        let images = (0..27).filter(|k| *k != 13).map(|k| {
            let shift: [f64; 3] = std::array::from_fn(|i| lengths[i] * f64::from(k / 3_i32.pow(i as u32) % 3 - 1));
            body.gap(Ellipsoid { place: std::array::from_fn(|i| place[i] + shift[i]), ..body })
        });
        let cube = PeriodicBox::new(lengths).unwrap();
        check(alone(degree).with_surroundings(cube).unwrap(), images.fold(f64::INFINITY, f64::min), "box");
    }
}
