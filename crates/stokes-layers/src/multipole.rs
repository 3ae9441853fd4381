//! The flow between curves that are far from each other, and of images: multipole expansions.
//!
//! What is left of the Green's function between two curves when the images that are close have been summed node by node
//! is smooth. Its Taylor series is summed by the moments of the sources.

mod expansion;
mod series;

use input_checks::InputError;
use num_complex::Complex64;

use crate::{
    Geometry,
    curve::Curve,
    greens::{FreePair, LatticePair, RowPair, Vectors},
    layer::{Dipoles, DirectPair, Kept, Pair},
};
use expansion::{Expansion, Moments};
use series::{Extent, LARGEST_RATIO, MOST_DEGREES, Series, SeriesFinder};

/// Fewest terms of a series.
const LEAST_DEGREE: usize = 4;
/// Safety factor of an accuracy that is asked for.
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
    geometry: Geometry,
    tolerance: f64,
    finder: SeriesFinder,
    /// The series of a box around the source itself, with its unit.
    own: Option<(Series, f64)>,
    expansion: Expansion,
    moments: Vec<Moments>,
    links: Vec<Link>,
    /// Links in use; the others keep their memory.
    used: usize,
    unit: f64,
    degree: usize,
    products: Vec<Complex64>,
    fluxes: Vec<f64>,
    /// Distances of the images that are summed node by node (length).
    direct: Vec<Complex64>,
}

impl Multipoles {
    pub(crate) fn new(geometry: Geometry, tolerance: f64) -> Result<Self, InputError> {
        let mut finder = SeriesFinder::new(&geometry, tolerance)?;
        let own = if let Geometry::Box { lengths: [lx, ly] } = geometry {
            let unit = lx.min(ly);
            let mut series = Series::new();
            let extent = Extent { reach: LARGEST_RATIO * unit, unit, degree: MOST_DEGREES };
            finder.find(Complex64::default(), &[Complex64::default()], extent, &mut series);
            Some((series, unit))
        } else {
            None
        };
        Ok(Self {
            geometry,
            tolerance,
            finder,
            own,
            expansion: Expansion::default(),
            moments: Vec::new(),
            links: Vec::new(),
            used: 0,
            unit: 1.0,
            degree: 0,
            products: Vec::new(),
            fluxes: Vec::new(),
            direct: Vec::new(),
        })
    }

    /// Divides the Green's function between all curves into sums over nodes, which are added to `pairs`, and series.
    pub(crate) fn divide(&mut self, curves: &[Curve], kept: Kept, pairs: &mut Vec<DirectPair>) {
        self.used = 0;
        self.degree = 0;
        // Lengths are in units of the largest radius.
        let closed = curves.iter().filter(|curve| !curve.is_open());
        self.unit = closed.map(|curve| curve.radius).fold(0.0, f64::max);
        self.moments.resize_with(curves.len(), Moments::default);
        for target in 0..curves.len() {
            for source in target..curves.len() {
                if kept.is_kept(target) || kept.is_kept(source) || curves[target].is_open() || curves[source].is_open()
                {
                    if kept.pair(target, source) {
                        pairs.push(self.whole_pair(curves, [target, source]));
                    }
                } else {
                    self.divide_pair(curves, [target, source], pairs);
                }
            }
        }
    }

    /// All images summed node by node: for curves that no series reaches around, and where the sums are kept.
    fn whole_pair(&self, curves: &[Curve], [target, source]: [usize; 2]) -> DirectPair {
        let own = target == source;
        let swap = curves[target].len() > curves[source].len();
        let [target, source] = if swap { [source, target] } else { [target, source] };
        let offset = self.geometry.images().wrap(curves[source].centre - curves[target].centre);
        let offset = [offset.re, offset.im];
        let kernel = match self.geometry {
            Geometry::Plane => Pair::Free(FreePair { offset }),
            Geometry::Channel { length, .. } => Pair::Row(RowPair::new(std::f64::consts::TAU / length, offset)),
            Geometry::Box { lengths } => Pair::Lattice(LatticePair::new(lengths, offset, self.tolerance)),
        };
        DirectPair { target, source, own, kernel }
    }

    fn divide_pair(&mut self, curves: &[Curve], [target, source]: [usize; 2], pairs: &mut Vec<DirectPair>) {
        let own = target == source;
        let reach = curves[target].radius + curves[source].radius;
        let too_close = |distance: Complex64| reach > LARGEST_RATIO * distance.norm();
        let distance = self.geometry.images().wrap(curves[target].centre - curves[source].centre);
        self.direct.clear();
        let (mut nearest, mut direct) = (distance.norm(), own || too_close(distance));
        // The one with fewer nodes is the target of the sums.
        let swap = curves[target].len() > curves[source].len();
        let ends = if swap { [source, target] } else { [target, source] };
        let mut sum_over_nodes = |kernel, own| pairs.push(DirectPair { target: ends[0], source: ends[1], own, kernel });
        let to_source = |e: Complex64| if swap { [e.re, e.im] } else { [-e.re, -e.im] };
        let free = |e: Complex64| Pair::Free(FreePair { offset: to_source(e) });
        match self.geometry {
            Geometry::Plane if direct => sum_over_nodes(free(distance), own),
            Geometry::Channel { length, .. } if direct => {
                let k = std::f64::consts::TAU / length;
                sum_over_nodes(Pair::Row(RowPair::new(k, to_source(distance))), own);
            }
            Geometry::Plane | Geometry::Channel { .. } => {}
            Geometry::Box { lengths: [lx, ly] } => {
                (nearest, direct) = (f64::INFINITY, false);
                for (i, j) in (-2..=2).flat_map(|i| (-2..=2).map(move |j| (i, j))) {
                    let e = distance + Complex64::new(f64::from(i) * lx, f64::from(j) * ly);
                    let itself = own && (i, j) == (0, 0);
                    if !itself && !too_close(e) {
                        nearest = nearest.min(e.norm());
                        continue;
                    }
                    self.direct.push(e);
                    // A pair of curves serves both directions, so of two opposite images of its own one is enough.
                    if !own || (i, j) >= (0, 0) {
                        sum_over_nodes(free(e), itself);
                    }
                }
            }
        }
        if !direct {
            let ratio = (reach / nearest).min(LARGEST_RATIO);
            let degree = ((self.tolerance.ln() / ratio.ln()).ceil() as usize).clamp(LEAST_DEGREE, MOST_DEGREES);
            self.link([target, source], distance, Extent { reach, unit: self.unit, degree });
        }
    }

    /// Adds the series between two curves and its reverse.
    fn link(&mut self, [target, source]: [usize; 2], distance: Complex64, extent: Extent) {
        self.degree = self.degree.max(extent.degree);
        let index = self.next(target, source);
        let series = &mut self.links[index].series;
        match &self.own {
            _ if self.geometry == Geometry::Plane => series.free(distance, extent),
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

    /// The number of a link that is not in use, with its memory.
    fn next(&mut self, target: usize, source: usize) -> usize {
        if self.used == self.links.len() {
            self.links.push(Link { target, source, series: Series::new() });
        }
        let link = &mut self.links[self.used];
        (link.target, link.source) = (target, source);
        self.used += 1;
        self.used - 1
    }

    /// Adds the flow of the forces; `curves` are those whose sums are not kept.
    pub(crate) fn add_forces(&mut self, curves: &[Curve], out: &mut [Vectors]) {
        if self.used == 0 {
            return;
        }
        for (curve, moments) in curves.iter().zip(&mut self.moments) {
            moments.clear(self.degree);
            if curve.is_open() {
                continue;
            }
            self.expansion.forces(self.unit, &curve.nodes.position, &curve.nodes.force, moments);
        }
        self.add_flow(curves, self.degree, out);
    }

    /// Adds the flow of the dipoles of each curve to an accuracy relative to them.
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
        // Terms fall off geometrically: a part of the digits needs that part of the terms.
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
            self.expansion.begin(degree);
            let mut any = false;
            for link in self.links[..self.used].iter().filter(|link| link.target == target) {
                self.expansion.add(&link.series, &self.moments[link.source], self.unit);
                any = true;
            }
            if any {
                self.expansion.add_flow(&curve.nodes.position, self.unit, self.geometry.area(), out);
            }
        }
    }
}
