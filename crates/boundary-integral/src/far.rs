//! Which pairs of interfaces go by sums over nodes and which by series, and the sums of the latter.

use num_complex::Complex64;

use crate::{
    expansion::{Expansion, Moments},
    interface::Interface,
    layers::Pair,
    planes::Vectors,
    series::{Extent, LARGEST_RATIO, MOST_DEGREES, Series, SeriesFinder},
    stress::Dipoles,
};

/// Fewest terms of a series.
const LEAST_DEGREE: usize = 4;
/// Safety factor of an accuracy that is asked for.
const MARGIN: f64 = 1e-3;

/// The part of the Green's function between two interfaces that does not go by sums over nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Smooth {
    /// There is none.
    Nothing,
    /// Free space.
    Free,
    /// All images less those that go by sums over nodes.
    Images,
}

/// How the Green's function between two interfaces is divided up.
#[derive(Debug)]
pub(crate) struct Division {
    /// Centre of the target minus centre of the source or its closest image (length).
    pub(crate) distance: Complex64,
    /// What goes by sums over nodes, and whether it is an interface with itself.
    pub(crate) pairs: Vec<(Pair, bool)>,
    /// The distances of the images that do.
    pub(crate) direct: Vec<Complex64>,
    /// The least distance of those that do not (length).
    pub(crate) nearest: f64,
    pub(crate) smooth: Smooth,
}

impl Division {
    pub(crate) fn new() -> Self {
        Self {
            distance: Complex64::default(),
            pairs: Vec::new(),
            direct: Vec::new(),
            nearest: f64::INFINITY,
            smooth: Smooth::Nothing,
        }
    }

    /// Starts anew for a pair of interfaces.
    pub(crate) fn clear(&mut self, distance: Complex64) {
        self.distance = distance;
        self.pairs.clear();
        self.direct.clear();
        self.nearest = f64::INFINITY;
        self.smooth = Smooth::Nothing;
    }
}

/// Whether two interfaces whose nodes are up to `reach` from their centres are too close for a series.
pub(crate) fn too_close(reach: f64, distance: Complex64) -> bool {
    reach > LARGEST_RATIO * distance.norm()
}

/// A source and a target with the series between them.
#[derive(Debug)]
struct Link {
    target: usize,
    source: usize,
    series: Series,
}

/// Series between interfaces and the moments that go with them.
#[derive(Debug)]
pub(crate) struct Far {
    tolerance: f64,
    /// Area of a box (length squared), infinite otherwise.
    area: f64,
    finder: Option<SeriesFinder>,
    /// The series around the source itself, with this unit.
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
}

impl Far {
    /// `period` is the shorter one of a box, where there is a series around a source itself.
    pub(crate) fn new(mut finder: Option<SeriesFinder>, area: f64, period: Option<f64>, tolerance: f64) -> Self {
        let own = period.zip(finder.as_mut()).map(|(period, finder)| {
            let extent = Extent { reach: LARGEST_RATIO * period, unit: period, degree: MOST_DEGREES };
            let mut series = Series::new();
            finder.find(Complex64::default(), &[Complex64::default()], extent, &mut series);
            (series, period)
        });
        Self {
            tolerance,
            area,
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
        }
    }

    /// Forgets all series; lengths will be in units of the largest radius.
    pub(crate) fn clear(&mut self, interfaces: &[Interface]) {
        self.used = 0;
        self.degree = 0;
        self.unit = interfaces.iter().map(|interface| interface.radius).fold(0.0, f64::max);
        self.moments.resize_with(interfaces.len(), Moments::default);
    }

    /// Adds the series between two interfaces and its reverse.
    pub(crate) fn link(&mut self, interfaces: &[Interface], [target, source]: [usize; 2], division: &Division) {
        if division.smooth == Smooth::Nothing {
            return;
        }
        let reach = interfaces[target].radius + interfaces[source].radius;
        let ratio = (reach / division.nearest).min(LARGEST_RATIO);
        let degree = ((self.tolerance.ln() / ratio.ln()).ceil() as usize).clamp(LEAST_DEGREE, MOST_DEGREES);
        self.degree = self.degree.max(degree);
        let extent = Extent { reach, unit: self.unit, degree };
        let mut link = self.take(target, source);
        let series = &mut link.series;
        if division.smooth == Smooth::Free {
            series.free(division.distance, extent);
        } else if target == source
            && division.direct.len() == 1
            && let Some((own, period)) = &self.own
        {
            series.rescale(own, extent.unit / period, degree);
        } else if let Some(finder) = &mut self.finder {
            finder.find(division.distance, &division.direct, extent, series);
        }
        if target != source {
            let mut back = self.take(source, target);
            back.series.reverse(&link.series);
            self.put(back);
        }
        self.put(link);
    }

    /// An unused link with its memory.
    fn take(&mut self, target: usize, source: usize) -> Link {
        let mut link = if self.links.len() > self.used {
            self.links.swap_remove(self.used)
        } else {
            Link { target, source, series: Series::new() }
        };
        (link.target, link.source) = (target, source);
        link
    }

    fn put(&mut self, link: Link) {
        self.links.push(link);
        let last = self.links.len() - 1;
        self.links.swap(self.used, last);
        self.used += 1;
    }

    /// Adds the flow of the forces.
    pub(crate) fn add_forces(&mut self, interfaces: &[Interface], out: &mut [Vectors]) {
        if self.used == 0 {
            return;
        }
        for (interface, moments) in interfaces.iter().zip(&mut self.moments) {
            moments.clear(self.degree);
            self.expansion.forces(self.unit, &interface.position, &interface.force, moments);
        }
        self.add_flow(interfaces, self.degree, out);
    }

    /// Adds the flow of the dipoles to an accuracy relative to them.
    pub(crate) fn add_dipoles(
        &mut self,
        interfaces: &[Interface],
        dipoles: &[Dipoles],
        accuracy: f64,
        out: &mut [Vectors],
    ) {
        if self.used == 0 {
            return;
        }
        // Terms fall off geometrically: a part of the digits needs that part of the terms.
        let part = ((MARGIN * accuracy).ln() / self.tolerance.ln()).clamp(0.0, 1.0);
        let degree = ((part * self.degree as f64).ceil() as usize).max(LEAST_DEGREE);
        for ((interface, dipoles), moments) in interfaces.iter().zip(dipoles).zip(&mut self.moments) {
            moments.clear(degree);
            self.products.clear();
            self.fluxes.clear();
            for i in 0..interface.nodes() {
                self.products.push(Complex64::new(dipoles.xx[i] - dipoles.yy[i], dipoles.s[i]));
                self.fluxes.push(dipoles.xx[i] + dipoles.yy[i]);
            }
            self.expansion.dipoles(self.unit, &interface.position, &self.products, &self.fluxes, moments);
        }
        self.add_flow(interfaces, degree, out);
    }

    fn add_flow(&mut self, interfaces: &[Interface], degree: usize, out: &mut [Vectors]) {
        for (target, (interface, out)) in interfaces.iter().zip(out).enumerate() {
            self.expansion.begin(degree);
            let mut any = false;
            for link in self.links[..self.used].iter().filter(|link| link.target == target) {
                self.expansion.add(&link.series, &self.moments[link.source], self.unit);
                any = true;
            }
            if any {
                self.expansion.add_flow(&interface.position, self.unit, self.area, out);
            }
        }
    }
}
