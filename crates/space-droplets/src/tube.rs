//! Droplets in a rigid tube: no slip on its wall in closed form.

mod bessel;
mod moments;
mod rule;
mod wall;
mod waves;

use std::f64::consts::PI;

use motile_base::internal::Refuse;
use motile_base::{finite, positive, within};
use num_complex::Complex64;
use stokes_boundary_integrals::internal::{MOST_SHARES, each_share};

use crate::SpaceError;
use crate::surface::dot;
use crate::surroundings::{Components, Sources, Surroundings, Targets, edge};
use moments::{Factors, Moments, NO_FLOW, Parity, add_solutions};
use rule::{Node, Reach, Rules, Survey};
use waves::{Functions, LANES, NONE, Points, Sums};

/// A straight rigid tube of infinite length, whose ends let no fluid through.
///
/// Its wall does not slip, to round-off: the flow that the wall adds is a sum over waves around and along the axis,
/// each in closed form. Waves that change the droplets' velocities by less than about 3e-10 of the wall's flow are left
/// out ([`Tube::with_tolerance`]). So a droplet that nearly touches the wall needs more waves, and a droplet off the
/// axis too.
///
/// Without droplets, the fluid is at rest. [`Tube::with_mean_flow`] adds a flow of Poiseuille.
///
/// ```
/// use space_droplets::{ContractileTension, ExcludedVolume, SpaceDroplet, Tube};
///
/// // A droplet with a gradient of tension along the tube swims more slowly than in unbounded fluid.
/// let law = || ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0);
/// let droplet = SpaceDroplet::sphere(8, 1.0, [1.0, 1.0], law()?)?.with_particles(0.1, |s| 1.0 + s[2])?;
/// let mut droplet = droplet.with_surroundings(Tube::new(2.0)?)?;
/// let ratio = droplet.observe()?.velocity[2] / (-1.0 / 15.0);
/// println!("velocity over the one in unbounded fluid {ratio:.4}");
/// assert!(ratio > 0.5 && ratio < 0.9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Tube {
    radius: f64,
    /// Two directions across the axis, and its direction.
    frame: [[f64; 3]; 3],
    mean_flow: f64,
    tolerance: f64,
    rules: Rules,
    survey: Survey,
    forces: Points,
    stresslets: Points,
    targets: Points,
    shares: Vec<Share>,
}

/// Waves that one thread works on.
#[derive(Debug, Clone, Default)]
struct Share {
    /// The first of its waves.
    first: usize,
    functions: Functions,
    sums: [Vec<Sums>; 2],
    factors: Vec<Factors>,
    flow: Vec<[[f64; LANES]; 3]>,
}

/// Part of the wall's flow at droplets that is left out.
const TOLERANCE: f64 = 3e-10;
/// Part of the root of the accuracy of a rough flow, which counts for waves that fade on the way back as well
/// (measured).
const PART: f64 = 0.03;
/// Distance, over the radius, within which points are as far from the wall as others.
const SAME_RADIUS: f64 = 0.02;
/// Largest part that may be left out.
const LEAST_ACCURATE: f64 = 0.01;

impl Tube {
    /// Creates a tube of this radius (length) around the z axis.
    ///
    /// # Errors
    /// Returns an error if the radius is not positive and finite.
    pub fn new(radius: f64) -> Result<Self, SpaceError> {
        Ok(Self {
            radius: positive("the radius of the tube", radius)?,
            frame: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            mean_flow: 0.0,
            tolerance: TOLERANCE,
            rules: Rules::default(),
            survey: Survey::default(),
            forces: Points::default(),
            stresslets: Points::default(),
            targets: Points::default(),
            shares: (0..MOST_SHARES).map(|first| Share { first, ..Share::default() }).collect(),
        })
    }

    /// Lays the axis along another direction, through the origin.
    ///
    /// # Errors
    /// Returns an error if the direction is zero or not finite.
    pub fn along(mut self, direction: [f64; 3]) -> Result<Self, SpaceError> {
        for x in direction {
            finite("a component of the tube's direction", x)?;
        }
        let largest = direction.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        positive("the largest component of the tube's direction", largest)?;
        let scaled = direction.map(|x| x / largest);
        let norm = dot(scaled, scaled).sqrt();
        let axis = scaled.map(|x| x / norm);
        // The coordinate axis that is the most across.
        let smallest = (0..3).fold(0, |best, i| if axis[i].abs() < axis[best].abs() { i } else { best });
        let mut across: [f64; 3] = std::array::from_fn(|i| f64::from(i == smallest) - axis[smallest] * axis[i]);
        let norm = dot(across, across).sqrt();
        across = across.map(|x| x / norm);
        let [a, b] = [axis, across];
        let third = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        self.frame = [across, third, axis];
        Ok(self)
    }

    /// Adds a flow along the tube with this mean velocity (length per time).
    ///
    /// # Errors
    /// Returns an error if the velocity is not finite.
    pub fn with_mean_flow(mut self, velocity: f64) -> Result<Self, SpaceError> {
        self.mean_flow = finite("the mean velocity in the tube", velocity)?;
        Ok(self)
    }

    /// Leaves out waves that change the wall's flow at droplets by about less than this fraction; 3e-10 by default.
    /// With 1e-5, a flow needs far fewer waves, and its error is still smaller than the truncation of most swimmers.
    ///
    /// # Errors
    /// Returns an error if the tolerance is not between 1e-13 and 0.01.
    pub fn with_tolerance(mut self, tolerance: f64) -> Result<Self, SpaceError> {
        self.tolerance = within("the tolerance of the tube", tolerance, 1e-13, LEAST_ACCURATE)?;
        Ok(self)
    }

    /// Returns the radius (length).
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Returns a place in units of the radius and in the frame of the tube.
    fn place(&self, place: [f64; 3]) -> [f64; 3] {
        self.frame.map(|direction| dot(direction, place) / self.radius)
    }

    /// Returns a vector in the frame of the tube.
    fn vector(&self, vector: [f64; 3]) -> [f64; 3] {
        self.frame.map(|direction| dot(direction, vector))
    }

    /// Takes over sources and targets; places along the axis count from `middle`.
    fn load(&mut self, sources: &[Sources<'_>], targets: &[Targets<'_>], middle: f64) {
        let [mut forces, mut stresslets, mut points] =
            [&mut self.forces, &mut self.stresslets, &mut self.targets].map(std::mem::take);
        forces.clear();
        stresslets.clear();
        points.clear();
        let place = |places: &Components<'_>, k: usize| {
            let [x, y, z] = self.place(at(places, k));
            [x, y, z - middle]
        };
        for source in sources {
            match source {
                Sources::Forces { places, forces: list } => {
                    for k in 0..places[0].len() {
                        let [x, y, z] = self.vector(at(list, k));
                        forces.push(place(places, k), [x, y, z, 0.0, 0.0, 0.0]);
                    }
                }
                Sources::Stresslets { places, normals, velocities } => {
                    for k in 0..places[0].len() {
                        // Velocities are divided by the radius below, and derivatives by another one here.
                        let n = self.vector(at(normals, k)).map(|component| component / self.radius);
                        let u = self.vector(at(velocities, k));
                        let product = |i: usize, j: usize| u[i] * n[j] + n[i] * u[j];
                        let pairs = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];
                        stresslets.push(place(places, k), pairs.map(|(i, j)| product(i, j)));
                    }
                }
            }
        }
        for target in targets {
            for k in 0..target.places[0].len() {
                points.push(place(&target.places, k), [0.0; waves::MOST_WEIGHTS]);
            }
        }
        (self.forces, self.stresslets, self.targets) = (forces, stresslets, points);
    }
}

/// Returns a vector of three lists.
fn at(list: &Components<'_>, k: usize) -> [f64; 3] {
    list.map(|component| component[k])
}

/// Returns the places of sources.
fn places_of<'a>(source: &Sources<'a>) -> Components<'a> {
    match source {
        Sources::Forces { places, .. } | Sources::Stresslets { places, .. } => *places,
    }
}

/// Computes the moments of a wave and order from the sums over forces and over stresslets.
fn moments(sums: &[Vec<Sums>; 2], node: &Node, m: usize, parity: Parity) -> Moments {
    let of = |number: usize| {
        let (k, sums, answers) = (node.k, &sums[number][..], &node.answers[..]);
        let sources = moments::Sources { k, sums, answers, stresslets: number == 1 };
        if sums.is_empty() { [Complex64::ZERO; 3] } else { sources.moments(m, parity) }
    };
    let [forces, stresslets] = [of(0), of(1)];
    std::array::from_fn(|s| forces[s] + stresslets[s])
}

/// Returns the multiples of the solutions by which the wall answers.
fn answer(node: &Node, m: usize, moments: &Moments) -> Moments {
    let matrix = &node.answers[m].matrix;
    std::array::from_fn(|s| (0..3).map(|t| matrix[(s, t)] * moments[t]).sum())
}

impl Share {
    /// Sums the sources over the functions of a wave.
    fn gather(&mut self, [forces, stresslets]: [&Points; 2], k: f64, orders: usize) {
        let all = orders + 2;
        self.functions.prepare(k, all);
        for ((points, weights), sums) in [(forces, 3), (stresslets, 6)].into_iter().zip(&mut self.sums) {
            sums.clear();
            if points.count > 0 {
                sums.resize(all, NONE);
                self.functions.gather(points, k, weights, sums);
            }
        }
    }

    /// Writes the work of the wall for each order of a wave: a measure of how much the wave counts.
    fn energies(&mut self, points: [&Points; 2], node: &Node, orders: usize, energies: &mut Vec<f64>) {
        self.gather(points, node.k, orders);
        energies.clear();
        for m in 0..orders {
            let energy = |parity: Parity| {
                let moments = moments(&self.sums, node, m, parity);
                let answer = answer(node, m, &moments);
                moments.iter().zip(&answer).map(|(a, b)| (a.conj() * b).re).sum::<f64>()
            };
            energies.push(Parity::BOTH.map(energy).iter().sum::<f64>() * if m == 0 { 1.0 } else { 2.0 });
        }
    }

    /// Adds the flow of a wave at the targets.
    fn add(&mut self, points: [&Points; 2], targets: &Points, node: &Node, orders: usize) {
        self.gather(points, node.k, orders);
        self.factors.clear();
        self.factors.resize(orders + 2, NO_FLOW);
        for m in 0..orders {
            let scale = -node.weight * if m == 0 { 1.0 } else { 2.0 } / (2.0 * PI * PI);
            for parity in Parity::BOTH {
                let multiples = answer(node, m, &moments(&self.sums, node, m, parity)).map(|value| scale * value);
                add_solutions(node.k, m, parity, &node.answers[m], &multiples, &mut self.factors);
            }
        }
        self.functions.spread(targets, node.k, &self.factors, &mut self.flow);
    }
}

impl Tube {
    /// Adds the flow of the wall without waves that change it by less than the tolerance.
    fn add(&mut self, sources: &[Sources<'_>], targets: &mut [Targets<'_>], tolerance: f64) -> Result<(), SpaceError> {
        let mut reach = Reach::default();
        for (places, source) in sources
            .iter()
            .map(|source| (places_of(source), true))
            .chain(targets.iter().map(|target| (target.places, false)))
        {
            for k in 0..places[0].len() {
                let [x, y, z] = self.place(at(&places, k));
                let r = x.hypot(y);
                if !(r < 1.0 || (!source && r < 1.0 + 1e-9)) {
                    let what = "a flow in the tube is asked for or made at a point that is not inside it";
                    let value = format!("the distance from the axis is {} of {}", r * self.radius, self.radius);
                    return Err(SpaceError::refused(what, value, "Use points inside the tube"));
                }
                reach.add(z);
            }
        }
        self.load(sources, targets, reach.middle());
        let Self { rules, survey, forces, stresslets, targets: points, shares, radius, .. } = self;
        let all = [&*forces, &*stresslets];
        let share = &mut shares[0];
        let energies = |node: &Node, orders: usize, list: &mut Vec<f64>| share.energies(all, node, orders, list);
        if !survey.update(rules, tolerance, energies)? {
            return Ok(());
        }
        let (survey, nodes) = (&*survey, rules.nodes(survey, reach.length(), tolerance)?);
        for share in &mut *shares {
            share.flow.clear();
            share.flow.resize(points.count.div_ceil(LANES), [[0.0; LANES]; 3]);
        }
        let number = shares.len();
        each_share(shares, |share| {
            for node in nodes.iter().skip(share.first).step_by(number) {
                share.add(all, points, node, survey.orders(node.k));
            }
        });
        let mut next = 0;
        for target in targets {
            for k in 0..target.places[0].len() {
                let part = |share: &Share, i: usize| share.flow[next / LANES][i][next % LANES];
                let sums: [f64; 3] = std::array::from_fn(|i| shares.iter().map(|share| part(share, i)).sum());
                for (i, flow) in target.flow.iter_mut().enumerate() {
                    flow[k] += (0..3).map(|j| self.frame[j][i] * sums[j]).sum::<f64>() / *radius;
                }
                next += 1;
            }
        }
        Ok(())
    }
}

impl Surroundings for Tube {
    fn add_flow(&mut self, sources: &[Sources<'_>], targets: &mut [Targets<'_>]) -> Result<(), SpaceError> {
        self.add(sources, targets, self.tolerance)
    }

    fn add_rough_flow(
        &mut self,
        sources: &[Sources<'_>],
        targets: &mut [Targets<'_>],
        accuracy: f64,
    ) -> Result<(), SpaceError> {
        let farthest = |most: f64, places: Components<'_>| {
            let radius = |k: usize| {
                let [x, y, _] = self.place(at(&places, k));
                x.hypot(y)
            };
            (0..places[0].len()).map(radius).fold(most, f64::max)
        };
        let from = sources.iter().map(Sources::places).fold(0.0, farthest);
        let to = targets.iter().map(|target| target.places).fold(0.0, farthest);
        // Few different tolerances let rules be used again.
        let accuracy = 10.0_f64.powf(accuracy.max(f64::MIN_POSITIVE).log10().floor());
        // A wave that fades from the sources to the wall fades as much on the way back to points as far from it.
        let tolerance = if to < from + SAME_RADIUS { PART * accuracy.sqrt() } else { accuracy };
        self.add(sources, targets, tolerance.clamp(self.tolerance, LEAST_ACCURATE))
    }

    fn check(&self, time: f64, droplet: usize, places: Components<'_>) -> Result<(), SpaceError> {
        let mut most = 0.0_f64;
        for k in 0..places[0].len() {
            let [x, y, _] = self.place(at(&places, k));
            most = most.max(x.hypot(y));
        }
        if most < 1.0 {
            return Ok(());
        }
        let wall = format!(
            "the wall of the tube of radius {}: it reaches to {:.4} from the axis",
            self.radius,
            most * self.radius
        );
        let remedy = "Use a wider tube or a smaller droplet, or move it to the axis; in a run, use shorter steps";
        Err(SpaceError::Wall { time, droplet, wall, remedy })
    }

    fn imposed(&self, place: [f64; 3]) -> [f64; 3] {
        let [x, y, _] = self.place(place);
        let speed = 2.0 * self.mean_flow * (1.0 - x * x - y * y);
        self.frame[2].map(|component| speed * component)
    }

    fn gap(&self, places: Components<'_>) -> f64 {
        let gap = |k: usize| {
            let [x, y, _] = self.place(at(&places, k));
            self.radius * (1.0 - x.hypot(y))
        };
        (0..places[0].len()).map(gap).fold(f64::INFINITY, f64::min)
    }

    fn outline(&self, middle: [f64; 3], reach: f64) -> Vec<Vec<[f64; 3]>> {
        let [first, second, axis] = self.frame;
        let along = dot(axis, middle);
        let place = |angle: f64, end: f64| {
            let (sin, cos) = angle.sin_cos();
            let across = |i: usize| self.radius * (cos * first[i] + sin * second[i]);
            std::array::from_fn(|i| across(i) + (along + end) * axis[i])
        };
        let ends = [-reach, reach];
        let circles = ends.map(|end| (0..=96).map(|k| place(PI * f64::from(k) / 48.0, end)).collect());
        let sides = (0..8).map(|k| edge(place(PI * f64::from(k) / 4.0, -reach), place(PI * f64::from(k) / 4.0, reach)));
        circles.into_iter().chain(sides).collect()
    }

    fn properties(&self) -> Vec<(&'static str, f64)> {
        let [x, y, z] = self.frame[2];
        vec![
            ("the radius of the tube", self.radius),
            ("the mean velocity in the tube", self.mean_flow),
            ("the direction of the tube along x", x),
            ("the direction of the tube along y", y),
            ("the direction of the tube along z", z),
        ]
    }

    fn symmetric_about_z(&self) -> bool {
        self.frame[2][0] == 0.0 && self.frame[2][1] == 0.0
    }
}

#[cfg(test)]
mod tests;
