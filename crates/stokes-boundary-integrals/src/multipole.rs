//! Layers between curves that are far from each other, and of images: multipole expansions.
//!
//! Without the images that are close, which are summed node by node, the Green's function between two curves is smooth.
//! Its Taylor series is summed by the moments of the sources.
//!
//! Sums node by node, these series, and the split sums of [`crate::ewald`] all stay, because each is the cheapest
//! somewhere: at a tolerance of 1e-8 and equal viscosities, an evaluation takes 0.1, 0.1 and 1.2 million instructions
//! for one droplet of 64 nodes in the plane, and 18, 11 and 20 million for 16 droplets. For 32 droplets in a box, it
//! takes 72 million with series and 20 million with split sums, whose first evaluation takes 65 million more.

mod expansion;
mod series;

use std::ops::Range;

use motile_base::InputError;
use num_complex::Complex64;

use crate::images::Images;
use crate::{
    curve::Curve,
    density::StoredLayers,
    direct::{CurvePair, Dipoles},
    greens::{AnyPair, FreePair, LatticePair, RowPair, Vectors},
};
pub(crate) use expansion::{Expansion, Moments};
use motile_base::Region;
pub(crate) use series::{Extent, LARGEST_RATIO, MOST_DEGREES, Series, SeriesFinder};

/// Least degree of a series: the background terms of a box read moments up to the second, and two degrees more cost
/// nothing.
const LEAST_DEGREE: usize = 4;
/// Safety factor of an accuracy that is asked for: the ratio to the power of the degree leaves out the derivative of a
/// dipole, a factor of the degree, and the sum of all further terms, together about a hundred.
const MARGIN: f64 = 1e-3;

/// A source and a target with the series between them.
#[derive(Debug, Clone)]
struct Link {
    target: usize,
    source: usize,
    series: Series,
}

/// Series between curves and the moments that go with them.
#[derive(Debug, Clone)]
pub(crate) struct Multipoles {
    region: Region,
    images: Images,
    tolerance: f64,
    finder: SeriesFinder,
    /// Series between a curve and its own images in a box, the same for all curves, with its unit of length.
    own: Option<(Series, f64)>,
    expansion: Expansion,
    moments: Vec<Moments>,
    links: Vec<Link>,
    /// Number of links in use; the others keep their memory.
    used: usize,
    /// Numbers of the links in use, the links of each target together, and where the links of each target begin.
    by_target: Vec<usize>,
    starts: Vec<usize>,
    /// Unit of length of all series (length), the largest radius of a curve.
    unit: f64,
    /// Largest degree of a series in use.
    degree: usize,
    products: Vec<Complex64>,
    fluxes: Vec<f64>,
    /// Distances of the images that are summed node by node (length).
    direct: Vec<Complex64>,
}

impl Multipoles {
    pub(crate) fn new(region: Region, tolerance: f64) -> Result<Self, InputError> {
        let images = Images::of(&region, 0.0);
        let own = match region {
            Region::Box { lengths: [lx, ly] } => Some((Series::new(), lx.min(ly))),
            _ => None,
        };
        let mut multipoles = Self {
            region,
            images,
            tolerance,
            finder: SeriesFinder::new(&region, tolerance)?,
            own,
            expansion: Expansion::default(),
            moments: Vec::new(),
            links: Vec::new(),
            used: 0,
            by_target: Vec::new(),
            starts: Vec::new(),
            unit: 1.0,
            degree: 0,
            products: Vec::new(),
            fluxes: Vec::new(),
            direct: Vec::new(),
        };
        multipoles.find_own();
        Ok(multipoles)
    }

    /// Returns the relative accuracy of everything that is truncated.
    pub(crate) fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// Takes over displaced images.
    pub(crate) fn set_images(&mut self, images: Images) {
        self.images = images;
        self.finder.set_images(&self.region, images);
        self.find_own();
    }

    /// Finds the series between a curve and its own images.
    fn find_own(&mut self) {
        if let Some((series, unit)) = &mut self.own {
            let extent = Extent { reach: LARGEST_RATIO * *unit, unit: *unit, degree: MOST_DEGREES };
            self.finder.find(Complex64::default(), &[Complex64::default()], extent, series);
        }
    }

    /// Divides the Green's function between all curves into sums over nodes, which are added to `pairs`, and series.
    pub(crate) fn divide(&mut self, curves: &[Curve], stored: StoredLayers, pairs: &mut Vec<CurvePair>) {
        self.used = 0;
        self.degree = 0;
        let closed = curves.iter().filter(|curve| !curve.is_open());
        self.unit = closed.map(|curve| curve.radius).fold(0.0, f64::max);
        self.moments.resize_with(curves.len(), Moments::default);
        for target in 0..curves.len() {
            for source in target..curves.len() {
                let ends = [target, source];
                let whole = ends.iter().any(|&curve| {
                    curves[curve].is_open() || stored.has(curve) && !matches!(self.region, Region::Box { .. })
                });
                if !stored.couples(target, source) {
                    continue;
                }
                if whole {
                    pairs.push(self.whole_pair(curves, ends));
                } else {
                    self.divide_pair(curves, ends, pairs);
                }
            }
        }
        self.sort_by_target(curves.len());
    }

    /// Lists the links by their targets, the links of a target in the order in which they were found.
    fn sort_by_target(&mut self, curves: usize) {
        let Self { links, used, by_target, starts, .. } = self;
        starts.clear();
        starts.resize(curves + 1, 0);
        for link in &links[..*used] {
            starts[link.target] += 1;
        }
        let mut end = 0;
        for start in starts.iter_mut() {
            end += *start;
            *start = end;
        }
        by_target.resize(*used, 0);
        for (index, link) in links[..*used].iter().enumerate().rev() {
            starts[link.target] -= 1;
            by_target[starts[link.target]] = index;
        }
    }

    /// Returns a pair with all images summed node by node: for open curves, which no series reaches around, and in the
    /// plane or a channel for stored curves and those that are close.
    fn whole_pair(&self, curves: &[Curve], [target, source]: [usize; 2]) -> CurvePair {
        let own = target == source;
        let swap = curves[target].len() > curves[source].len();
        let [target, source] = if swap { [source, target] } else { [target, source] };
        let offset = self.images.wrap(curves[source].centre - curves[target].centre);
        let offset = [offset.re, offset.im];
        let kernel = match self.region {
            Region::Channel { length, .. } => AnyPair::Row(RowPair::new(std::f64::consts::TAU / length, offset)),
            Region::Box { lengths } => match self.images.tilt() {
                0.0 => AnyPair::Lattice(LatticePair::new(lengths, 0.0, offset, self.tolerance)),
                tilt => AnyPair::Sheared(LatticePair::new(lengths, tilt, offset, self.tolerance)),
            },
            _ => AnyPair::Free(FreePair { offset }),
        };
        CurvePair { target, source, own, kernel }
    }

    /// Divides the Green's function between two closed curves.
    fn divide_pair(&mut self, curves: &[Curve], [target, source]: [usize; 2], pairs: &mut Vec<CurvePair>) {
        let own = target == source;
        let reach = curves[target].radius + curves[source].radius;
        let too_close = |distance: Complex64| reach > LARGEST_RATIO * distance.norm();
        let distance = self.images.wrap(curves[target].centre - curves[source].centre);
        self.direct.clear();
        let mut nearest = distance.norm();
        if let Region::Box { lengths: [lx, ly] } = self.region {
            // The one with fewer nodes is the target of the sums.
            let swap = curves[target].len() > curves[source].len();
            let ends = if swap { [source, target] } else { [target, source] };
            nearest = f64::INFINITY;
            for (i, j) in (-2..=2).flat_map(|i| (-2..=2).map(move |j| (i, j))) {
                let e =
                    distance + Complex64::new(f64::from(i) * lx + f64::from(j) * self.images.tilt(), f64::from(j) * ly);
                let itself = own && (i, j) == (0, 0);
                if !itself && !too_close(e) {
                    nearest = nearest.min(e.norm());
                    continue;
                }
                self.direct.push(e);
                // A pair of curves serves both directions, so of two opposite images of its own one is enough.
                if !own || (i, j) >= (0, 0) {
                    let offset = if swap { [e.re, e.im] } else { [-e.re, -e.im] };
                    let kernel = AnyPair::Free(FreePair { offset });
                    pairs.push(CurvePair { target: ends[0], source: ends[1], own: itself, kernel });
                }
            }
        } else if own || too_close(distance) {
            pairs.push(self.whole_pair(curves, [target, source]));
            return;
        }
        let ratio = (reach / nearest).min(LARGEST_RATIO);
        let degree = ((self.tolerance.ln() / ratio.ln()).ceil() as usize).clamp(LEAST_DEGREE, MOST_DEGREES);
        self.link([target, source], distance, Extent { reach, unit: self.unit, degree });
    }

    /// Adds the series between two curves and its reverse.
    fn link(&mut self, [target, source]: [usize; 2], distance: Complex64, extent: Extent) {
        self.degree = self.degree.max(extent.degree);
        let index = self.next(target, source);
        let series = &mut self.links[index].series;
        match &self.own {
            _ if self.region == Region::Plane => series.free(distance, extent),
            Some((own, unit)) if target == source && self.direct.len() == 1 => {
                series.rescale(own, extent.unit / unit, extent.degree);
            }
            _ => self.finder.find(distance, &self.direct, extent, series),
        }
        if target != source {
            let reverse = self.next(source, target);
            let (links, reverse) = self.links.split_at_mut(reverse);
            reverse[0].series.reverse(&links[index].series);
        }
    }

    /// Returns the number of a link that was not in use.
    fn next(&mut self, target: usize, source: usize) -> usize {
        if self.used == self.links.len() {
            self.links.push(Link { target, source, series: Series::new() });
        }
        let link = &mut self.links[self.used];
        (link.target, link.source) = (target, source);
        self.used += 1;
        self.used - 1
    }

    /// Adds the flow of the forces on some of the curves.
    pub(crate) fn add_forces(&mut self, curves: &[Curve], from: Range<usize>, out: &mut [Vectors]) {
        if !self.links[..self.used].iter().any(|link| from.contains(&link.source)) {
            return;
        }
        for (index, (curve, moments)) in curves.iter().zip(&mut self.moments).enumerate() {
            moments.clear(self.degree);
            if !curve.is_open() && from.contains(&index) {
                self.expansion.forces(self.unit, &curve.nodes.position, &curve.nodes.force, moments);
            }
        }
        self.add_flow(curves, self.degree, out);
    }

    /// Adds the flow of the dipoles of curves that are not stored, to an `accuracy` relative to them.
    pub(crate) fn add_dipoles<'a>(
        &mut self,
        curves: &[Curve],
        dipoles: impl Iterator<Item = &'a Dipoles>,
        accuracy: f64,
        out: &mut [Vectors],
    ) {
        if self.used == 0 {
            return;
        }
        // Terms fall off geometrically: half of the digits need half of the terms.
        let part = ((MARGIN * accuracy).ln() / self.tolerance.ln()).clamp(0.0, 1.0);
        let degree = ((part * self.degree as f64).ceil() as usize).max(LEAST_DEGREE);
        for ((curve, dipoles), moments) in curves.iter().zip(dipoles).zip(&mut self.moments) {
            moments.clear(degree);
            if curve.is_open() {
                continue;
            }
            self.products.clear();
            self.fluxes.clear();
            for i in 0..curve.len() {
                self.products.push(Complex64::new(dipoles.xx[i] - dipoles.yy[i], dipoles.s[i]));
                self.fluxes.push(dipoles.xx[i] + dipoles.yy[i]);
            }
            self.expansion.dipoles(self.unit, &curve.nodes.position, &self.products, &self.fluxes, moments);
        }
        self.add_flow(curves, degree, out);
    }

    fn add_flow(&mut self, curves: &[Curve], degree: usize, out: &mut [Vectors]) {
        for (target, (curve, out)) in curves.iter().zip(out).enumerate() {
            let links = &self.by_target[self.starts[target]..self.starts[target + 1]];
            if links.is_empty() {
                continue;
            }
            self.expansion.begin(degree);
            for &index in links {
                let link = &self.links[index];
                self.expansion.add(&link.series, &self.moments[link.source], self.unit);
            }
            self.expansion.divide();
            self.expansion.add_flow(&curve.nodes.position, self.unit, self.images.area(), out);
        }
    }
}
