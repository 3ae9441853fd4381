//! A box around all nodes of the plane, and the flow of its images, which are not there.
//!
//! A place of flow and a node are nearer to each other than to any image by the ratio [`LARGEST_RATIO`], so that the
//! flow of all images together is one Taylor series about the middle.

use motile_base::{InputError, Region, Vec2};
use num_complex::Complex64;

use crate::{
    curve::Curve,
    greens::{Flow, Vectors},
    images::Images,
    multipole::{Expansion, Extent, LARGEST_RATIO, MOST_DEGREES, Moments, Series, SeriesFinder},
    shares,
};

/// Sides of boxes in a factor of 2, so that nodes that move a little leave the box as it is.
const CLASSES: f64 = 8.0;
/// Safety factor of the tolerance in the degree of the series: for the derivative of a dipole and all further terms.
const MARGIN: f64 = 1e-3;

/// The box and the series of its images.
#[derive(Debug, Clone)]
pub(super) struct Cluster {
    degree: usize,
    /// Side of the box (length).
    side: f64,
    centre: Complex64,
    series: Series,
    /// The flow of the images about the middle.
    expansion: Expansion,
    moments: Moments,
    /// Nodes relative to the middle (length), and what they carry.
    positions: Vec<Complex64>,
    carried: Vec<Complex64>,
    fluxes: Vec<f64>,
    /// Working memory of the shares of the nodes.
    shares: Vec<Share>,
}

/// Working memory of some of the nodes.
#[derive(Debug, Clone, Default)]
struct Share {
    expansion: Expansion,
    moments: Moments,
    flow: Vectors,
}

impl Cluster {
    pub(super) fn new(tolerance: f64) -> Self {
        let degree = ((MARGIN * tolerance).ln() / LARGEST_RATIO.ln()).ceil() as usize;
        let (centre, expansion, moments, positions, carried, fluxes, shares) = Default::default();
        let (degree, series) = (degree.min(MOST_DEGREES), Series::new());
        Self { degree, side: 0.0, centre, series, expansion, moments, positions, carried, fluxes, shares }
    }

    /// Takes over the places of curves, where the flow is asked for, and of points (length) at which it is asked for
    /// too; the images of another box, if they need one.
    ///
    /// # Errors
    /// Returns an error for a transform that cannot be planned.
    pub(super) fn set(&mut self, curves: &[Curve], points: &[Vec2]) -> Result<Images, InputError> {
        let (centre, radius) = circle(curves);
        self.centre = centre;
        let least = (radius + farthest(centre, points).max(radius)) / LARGEST_RATIO;
        let side = 2f64.powf((CLASSES * least.log2()).ceil() / CLASSES);
        let region = Region::Box { lengths: [side; 2] };
        if side != self.side {
            self.side = side;
            let extent = Extent { reach: LARGEST_RATIO * side, unit: side, degree: MOST_DEGREES };
            let mut finder = SeriesFinder::new(&region, f64::MIN_POSITIVE)?;
            finder.find(Complex64::default(), &[Complex64::default()], extent, &mut self.series);
        }
        Ok(Images::of(&region, 0.0))
    }

    /// Takes over the nodes.
    pub(super) fn place(&mut self, curves: &[Curve]) {
        self.positions.clear();
        let nodes = curves.iter().flat_map(|curve| curve.nodes.position.iter().map(|z| z + curve.centre));
        self.positions.extend(nodes.map(|z| z - self.centre));
    }

    /// Takes the flow of the images of forces, components at all nodes, from that at the nodes.
    pub(super) fn remove_forces(&mut self, forces: [&[f64]; 2], out: &mut [Vectors]) {
        self.take_forces(forces);
        self.remove(out);
    }

    /// Takes the flow of the images of dipoles, products xx, s, yy at all nodes, from that at the nodes.
    pub(super) fn remove_dipoles(&mut self, dipoles: [&[f64]; 3], out: &mut [Vectors]) {
        self.take_dipoles(dipoles);
        self.remove(out);
    }

    fn take_forces(&mut self, [x, y]: [&[f64]; 2]) {
        self.carried.clear();
        self.carried.extend(x.iter().zip(y).map(|(x, y)| Complex64::new(*x, *y)));
        self.fluxes.clear();
        self.add_moments(|share, side, positions, carried, _| {
            share.expansion.forces(side, positions, carried, &mut share.moments);
        });
    }

    fn take_dipoles(&mut self, [xx, s, yy]: [&[f64]; 3]) {
        self.carried.clear();
        self.fluxes.clear();
        for ((xx, s), yy) in xx.iter().zip(s).zip(yy) {
            self.carried.push(Complex64::new(xx - yy, *s));
            self.fluxes.push(xx + yy);
        }
        self.add_moments(|share, side, positions, carried, fluxes| {
            share.expansion.dipoles(side, positions, carried, fluxes, &mut share.moments);
        });
    }

    /// Computes the moments of all nodes, by `write` the moments of a share from its positions and what they carry, and
    /// the flow of the images from them.
    fn add_moments(&mut self, write: impl Fn(&mut Share, f64, &[Complex64], &[Complex64], &[f64]) + Sync + Send) {
        let Self { degree, side, series, expansion, moments, positions, carried, fluxes, shares: all, .. } = self;
        let len = shares::length(positions.len());
        all.resize_with(positions.len().div_ceil(len), Share::default);
        // Forces have no fluxes.
        fluxes.resize(positions.len(), 0.0);
        let nodes = positions.chunks(len).zip(carried.chunks(len)).zip(fluxes.chunks(len));
        shares::each_of(positions.len(), all.iter_mut().zip(nodes), |(share, ((positions, carried), fluxes))| {
            share.moments.clear(*degree);
            write(share, *side, positions, carried, fluxes);
        });
        moments.clear(*degree);
        all.iter().for_each(|share| moments.add(&share.moments));
        expansion.begin(*degree);
        expansion.add(series, moments, *side);
        expansion.divide();
    }

    /// Takes the flow of the images of forces at the nodes from that at points (length).
    pub(super) fn remove_forces_at(&mut self, [x, y]: [&[f64]; 2], points: &[Vec2], out: &mut [Flow]) {
        self.take_forces([x, y]);
        self.sample(points, -1.0, out);
    }

    /// Adds the flow of the images of dipoles at the nodes to that at points (length), which is without the double
    /// layers.
    pub(super) fn remove_dipoles_at(&mut self, dipoles: [&[f64]; 3], points: &[Vec2], out: &mut [Flow]) {
        self.take_dipoles(dipoles);
        self.sample(points, 1.0, out);
    }

    fn sample(&mut self, points: &[Vec2], sign: f64, out: &mut [Flow]) {
        let Self { expansion, positions, centre, side, .. } = self;
        positions.clear();
        positions.extend(points.iter().map(|point| Complex64::new(point.x, point.y) - *centre));
        expansion.add_samples(positions, *side, *side * *side, sign, out);
    }

    fn remove(&mut self, out: &mut [Vectors]) {
        let Self { expansion, positions, side, shares: all, .. } = self;
        let (expansion, len) = (&*expansion, shares::length(positions.len()));
        shares::each_of(positions.len(), all.iter_mut().zip(positions.chunks(len)), |(share, positions)| {
            share.flow.clear(positions.len());
            share.expansion.copy(expansion);
            share.expansion.add_flow(positions, *side, *side * *side, &mut share.flow);
        });
        let flows = all.iter().flat_map(|share| share.flow.x.iter().zip(&share.flow.y));
        let values = out.iter_mut().flat_map(|Vectors { x, y }| x.iter_mut().zip(y));
        for ((x, y), (u, v)) in values.zip(flows) {
            *x -= u;
            *y -= v;
        }
    }
}

/// Returns the middle of curves, and the radius of a circle about it that holds them (length).
fn circle(curves: &[Curve]) -> (Complex64, f64) {
    let mut corners = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    for Curve { centre, radius, .. } in curves {
        corners = [
            corners[0].min(centre.re - radius),
            corners[1].min(centre.im - radius),
            corners[2].max(centre.re + radius),
            corners[3].max(centre.im + radius),
        ];
    }
    let middle = 0.5 * Complex64::new(corners[0] + corners[2], corners[1] + corners[3]);
    let radius = curves.iter().map(|curve| (curve.centre - middle).norm() + curve.radius).fold(0.0, f64::max);
    (middle, radius)
}

/// Returns the distance from a place to the point that is farthest from it (length), 0 without points.
fn farthest(from: Complex64, points: &[Vec2]) -> f64 {
    points.iter().map(|point| (Complex64::new(point.x, point.y) - from).norm()).fold(0.0, f64::max)
}

/// Returns the distance to the farthest point from the middle of curves, over the radius of the circle around these.
pub(crate) fn spread(curves: &[Curve], points: &[Vec2]) -> f64 {
    let (centre, radius) = circle(curves);
    farthest(centre, points) / radius
}

/// Returns the part of the circle around all curves that the circles around each of them fill.
pub(crate) fn filling(curves: &[Curve]) -> f64 {
    let (_, radius) = circle(curves);
    curves.iter().map(|curve| (curve.radius / radius).powi(2)).sum()
}
