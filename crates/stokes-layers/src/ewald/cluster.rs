//! A box around all nodes of the plane, and the flow of its images, which are not there.
//!
//! Two places in the nodes' circle are nearer to each other than to any image by the ratio [`LARGEST_RATIO`], so that
//! the flow of all images together is one Taylor series about the middle.

use motile_base::{InputError, Region};
use num_complex::Complex64;

use crate::{
    curve::Curve,
    greens::Vectors,
    images::Images,
    multipole::{Expansion, Extent, LARGEST_RATIO, MOST_DEGREES, Moments, Series, SeriesFinder},
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
    expansion: Expansion,
    moments: Moments,
    /// Nodes relative to the middle (length), and what they carry.
    positions: Vec<Complex64>,
    carried: Vec<Complex64>,
    fluxes: Vec<f64>,
    flow: Vectors,
}

impl Cluster {
    pub(super) fn new(tolerance: f64) -> Self {
        let degree = ((MARGIN * tolerance).ln() / LARGEST_RATIO.ln()).ceil() as usize;
        let (centre, expansion, moments, positions, carried, fluxes, flow) = Default::default();
        let (degree, series) = (degree.min(MOST_DEGREES), Series::new());
        Self { degree, side: 0.0, centre, series, expansion, moments, positions, carried, fluxes, flow }
    }

    /// Takes over the places of curves; the images of another box, if they need one.
    ///
    /// # Errors
    /// A transform that cannot be planned.
    pub(super) fn set(&mut self, curves: &[Curve]) -> Result<Images, InputError> {
        let (centre, radius) = circle(curves);
        self.centre = centre;
        let least = 2.0 * radius / LARGEST_RATIO;
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
    pub(super) fn remove_forces(&mut self, [x, y]: [&[f64]; 2], out: &mut [Vectors]) {
        self.carried.clear();
        self.carried.extend(x.iter().zip(y).map(|(x, y)| Complex64::new(*x, *y)));
        self.moments.clear(self.degree);
        self.expansion.forces(self.side, &self.positions, &self.carried, &mut self.moments);
        self.remove(out);
    }

    /// Takes the flow of the images of dipoles, products xx, s, yy at all nodes, from that at the nodes.
    pub(super) fn remove_dipoles(&mut self, [xx, s, yy]: [&[f64]; 3], out: &mut [Vectors]) {
        self.carried.clear();
        self.fluxes.clear();
        for ((xx, s), yy) in xx.iter().zip(s).zip(yy) {
            self.carried.push(Complex64::new(xx - yy, *s));
            self.fluxes.push(xx + yy);
        }
        self.moments.clear(self.degree);
        self.expansion.dipoles(self.side, &self.positions, &self.carried, &self.fluxes, &mut self.moments);
        self.remove(out);
    }

    fn remove(&mut self, out: &mut [Vectors]) {
        let Self { expansion, series, moments, positions, flow, side, degree, .. } = self;
        expansion.begin(*degree);
        expansion.add(series, moments, *side);
        flow.clear(positions.len());
        expansion.add_flow(positions, *side, *side * *side, flow);
        let mut first = 0;
        for Vectors { x, y } in out {
            let all = first..first + x.len();
            x.iter_mut().zip(&flow.x[all.clone()]).for_each(|(x, u)| *x -= u);
            y.iter_mut().zip(&flow.y[all.clone()]).for_each(|(y, v)| *y -= v);
            first = all.end;
        }
    }
}

/// Middle of curves, and the radius of a circle about it that holds them (length).
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

/// Part of the circle around all curves that the circles around each of them fill.
pub(crate) fn filling(curves: &[Curve]) -> f64 {
    let (_, radius) = circle(curves);
    curves.iter().map(|curve| (curve.radius / radius).powi(2)).sum()
}
