//! Relaxation of stress: Maxwell elements in parallel with the elastic forces of a solid.

use motile_base::{Vec2, positive};

use crate::forces::{Bar, Element, Springs, add_stress_of_bar};
use crate::material::{DeformationGradient, Mat2};
use crate::mesh::TriangleMesh;
use crate::{Moduli, SolidError};

/// A Maxwell element: a spring in series with a dashpot, whose stress relaxes while the strain is kept.
///
/// One of them in parallel with an elastic solid makes a standard linear solid, whose shear stress after a step of
/// strain is `G(t) = Ginf + G1 exp(-t/tau)`; several make the generalised Maxwell model.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("viscoelastic", "relaxation time", "Kelvin-Voigt", "standard linear solid"))]
pub struct Maxwell {
    modulus: f64,
    time: f64,
}

impl Maxwell {
    /// Creates an element of the shear modulus G1 (force per length) and the relaxation time tau (time); `G1 tau` is
    /// the viscosity that it adds to slow motion.
    ///
    /// # Errors
    /// Returns an error for values that are not positive and finite.
    pub fn new(modulus: f64, time: f64) -> Result<Self, SolidError> {
        let modulus = positive("the modulus of the Maxwell element", modulus)?;
        Ok(Self { modulus, time: positive("the relaxation time", time)? })
    }

    /// Returns the shear modulus (force per length).
    #[must_use]
    pub fn modulus(&self) -> f64 {
        self.modulus
    }

    /// Returns the relaxation time (time).
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }
}

/// Fraction of a step below which stages take relaxation times as this fraction of it.
const SHORTEST: f64 = 1e-8;

/// A part of the mesh whose stress relaxes.
#[derive(Debug, Clone, Copy)]
struct Relaxing<T> {
    part: T,
    /// Index of the edge or triangle.
    index: usize,
    /// Spring constant or shear modulus (force per length).
    modulus: f64,
    /// Relaxation time (time).
    time: f64,
}

/// Maxwell elements of a solid, each with an internal variable that relaxes towards a function of the deformation:
///
/// ```text
/// springs:    tension K (r - l),                dl/dt = (r - l)/tau,        energy K/2 (r - l)^2
/// triangles:  P = mu (A G - A^-T),  G = Av^-1 Av^-T,  dG/dt = (C^-1 - G)/tau,
///             energy density mu/2 (tr b - 2 - ln det b),  b = A G A^T = Ae Ae^T
/// ```
///
/// with r the length of an edge and l that at which its spring is at rest; A = Ae Av the deformation gradient, split
/// into an elastic and a viscous part, and C = A^T A. The Cauchy stress of triangles follows the upper-convected
/// Maxwell model (Lubliner, Mech. Res. Commun. 12 (1985) 93), and what is dissipated is `mu/(2 tau) (tr b + tr b^-1 -
/// 4)` per reference area. Each update of G is a mean of positive definite matrices, so that it remains one at any
/// step.
#[derive(Debug, Clone, Default)]
pub(crate) struct Relaxation {
    bars: Vec<Relaxing<Bar>>,
    elements: Vec<Relaxing<Element>>,
    /// Internal variables: l of the bars (length), then xx, xy and yy of G of the triangles (no dimension).
    values: Vec<f64>,
    /// Internal variables and what they relaxed towards when the step began.
    before: Vec<[f64; 2]>,
    /// Shortest relaxation time that stages have (time), a fraction of the step. A shorter one is as good as none, and
    /// its rates would be round-off.
    shortest: f64,
    /// Positions of a stage.
    stage: Vec<Vec2>,
    /// Sum over the elements of their largest shear moduli (force per length).
    stiffest: f64,
    /// Sums over all of moduli and viscosities, by which solids are distinguished.
    sums: [f64; 2],
}

/// Returns the inverse of C = A^T A, as xx, xy, yy.
fn inverse_strain(gradient: &Mat2) -> [f64; 3] {
    let [a11, a21, a12, a22] = gradient.to_cols_array();
    let scale = 1.0 / gradient.determinant().powi(2);
    [(a22 * a22 + a12 * a12) * scale, -(a22 * a21 + a12 * a11) * scale, (a21 * a21 + a11 * a11) * scale]
}

/// Returns the symmetric matrix of the entries xx, xy, yy.
fn symmetric(&[xx, xy, yy]: &[f64; 3]) -> Mat2 {
    Mat2::from_rows_array(&[xx, xy, xy, yy])
}

impl Relaxing<Element> {
    /// Returns the first Piola-Kirchhoff stress (force per reference length) under a deformation gradient.
    fn stress(&self, gradient: &DeformationGradient, inner: &[f64; 3]) -> Mat2 {
        (gradient.matrix() * symmetric(inner) + gradient.cofactor() * (-1.0 / gradient.jacobian())) * self.modulus
    }
}

impl Relaxation {
    /// Adds a Maxwell element, a function of the reference position (length), to a solid at rest: to the springs along
    /// the edges where `springs`, otherwise to the triangles.
    ///
    /// # Errors
    /// Returns the errors of the function.
    pub(crate) fn add(
        &mut self,
        mesh: &TriangleMesh,
        springs: bool,
        mut element: impl FnMut(Vec2) -> Result<Maxwell, SolidError>,
    ) -> Result<(), SolidError> {
        let of_triangles = (0..mesh.triangles().len())
            .map(|triangle| element(mesh.centroid(triangle)))
            .collect::<Result<Vec<Maxwell>, SolidError>>()?;
        let mut triangles: Vec<(usize, Element)> = Vec::new();
        let mut added = 0;
        if springs {
            let each = |value: fn(&Maxwell) -> f64| {
                let mut next = of_triangles.iter();
                Springs::graded(mesh, |_| next.next().map_or(0.0, value))
            };
            let (elastic, viscous) = (each(Maxwell::modulus)?, each(|element| element.modulus * element.time)?);
            for (index, ((bar, modulus), (_, viscosity))) in elastic.bars().iter().zip(viscous.bars()).enumerate() {
                if *modulus > 0.0 {
                    self.bars.push(Relaxing { part: *bar, index, modulus: *modulus, time: viscosity / modulus });
                    added += 1;
                }
            }
            triangles.extend_from_slice(elastic.uneven());
        } else {
            triangles.extend(Element::all(mesh).into_iter().enumerate());
        }
        let split = self.bars.len() - added;
        self.values.splice(split..split, self.bars[split..].iter().map(|bar| bar.part.length));
        for (index, part) in triangles {
            let Maxwell { modulus, time } = of_triangles[index];
            self.elements.push(Relaxing { part, index, modulus, time });
            self.values.extend([1.0, 0.0, 1.0]);
        }
        self.stiffest += of_triangles.iter().map(Maxwell::modulus).fold(0.0, f64::max);
        for (element, area) in of_triangles.iter().zip(mesh.areas()) {
            self.sums[0] += element.modulus * area;
            self.sums[1] += element.modulus * element.time * area;
        }
        self.before.resize(self.values.len(), [0.0; 2]);
        self.stage.resize(mesh.points().len(), Vec2::ZERO);
        Ok(())
    }

    /// Returns the internal variables.
    pub(crate) fn values(&self) -> &[f64] {
        &self.values
    }

    /// Writes the sizes of the internal variables: of springs their lengths at rest (length), of triangles 1.
    pub(crate) fn write_scales(&self, scales: &mut [f64]) {
        scales.iter_mut().zip(&self.bars).for_each(|(scale, bar)| *scale = bar.part.length);
    }

    /// Returns the internal variables, to be overwritten.
    pub(crate) fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// Returns the largest shear modulus of small fast strains (force per length), an upper bound.
    pub(crate) fn stiffest(&self) -> f64 {
        self.stiffest
    }

    /// Integrals over the reference area of the moduli (force times length) and of the viscosities (times time).
    pub(crate) fn sums(&self) -> [f64; 2] {
        self.sums
    }

    fn inner(&self, element: usize) -> [f64; 3] {
        let start = self.bars.len() + 3 * element;
        [0, 1, 2].map(|k| self.values[start + k])
    }

    /// Adds the forces of the elements (force) with the points at `positions` (length).
    pub(crate) fn add_forces(&self, positions: &[Vec2], forces: &mut [Vec2]) -> Result<(), SolidError> {
        for (bar, rest) in self.bars.iter().zip(&self.values) {
            let span = bar.part.span(positions);
            let pull = bar.modulus * (1.0 - rest / span.length().max(f64::MIN_POSITIVE));
            bar.part.add_pull(span * pull, forces);
        }
        for (number, element) in self.elements.iter().enumerate() {
            let gradient = element.part.deformation(element.index, positions)?;
            element.part.add_forces(&element.stress(&gradient, &self.inner(number)), forces);
        }
        Ok(())
    }

    /// Returns the energy of the elements (energy), and what they dissipate (energy per time).
    pub(crate) fn energies(&self, positions: &[Vec2]) -> Result<[f64; 2], SolidError> {
        let mut energies = [0.0; 2];
        for (bar, rest) in self.bars.iter().zip(&self.values) {
            let energy = 0.5 * bar.modulus * (bar.part.span(positions).length() - rest).powi(2);
            energies[0] += energy;
            energies[1] += 2.0 * energy / bar.time;
        }
        for (number, element) in self.elements.iter().enumerate() {
            let gradient = element.part.deformation(element.index, positions)?.matrix();
            let b = gradient * symmetric(&self.inner(number)) * gradient.transpose();
            let (trace, det) = (b.trace(), b.determinant());
            let scale = 0.5 * element.modulus * element.part.area;
            energies[0] += scale * (trace - 2.0 - det.ln());
            energies[1] += scale / element.time * (trace + trace / det - 4.0);
        }
        Ok(energies)
    }

    /// Adds the Cauchy stresses of the elements (force per deformed length) to the stresses of the triangles of the
    /// mesh, none of which is inverted.
    pub(crate) fn add_stresses(&self, mesh: &TriangleMesh, positions: &[Vec2], stresses: &mut [Mat2]) {
        for (bar, rest) in self.bars.iter().zip(&self.values) {
            let tension = bar.modulus * (bar.part.span(positions).length() - rest);
            add_stress_of_bar((mesh, bar.index), (&bar.part, tension), positions, stresses);
        }
        for (number, element) in self.elements.iter().enumerate() {
            if let Some(gradient) = DeformationGradient::checked(element.part.gradient(positions)) {
                let stress = element.stress(&gradient, &self.inner(number));
                stresses[element.index] += stress * gradient.matrix().transpose() / gradient.jacobian();
            }
        }
    }

    /// Calls `act` with the relaxation time of each internal variable, its number, and what it relaxes towards with the
    /// points at `positions` (length).
    fn each_goal(&self, positions: &[Vec2], mut act: impl FnMut(f64, usize, f64)) {
        for (number, bar) in self.bars.iter().enumerate() {
            act(bar.time, number, bar.part.span(positions).length());
        }
        for (number, element) in self.elements.iter().enumerate() {
            let goals = inverse_strain(&element.part.gradient(positions));
            for (k, goal) in goals.into_iter().enumerate() {
                act(element.time, self.bars.len() + 3 * number + k, goal);
            }
        }
    }

    /// Takes the positions of a stage (length): the positions given, and for the points `free` the positions of the
    /// state.
    fn place(&mut self, positions: &[Vec2], free: &[usize], state: &[f64]) {
        self.stage.copy_from_slice(positions);
        for (pair, &point) in state.chunks_exact(2).zip(free) {
            self.stage[point] = Vec2::new(pair[0], pair[1]);
        }
    }

    /// Adds `factor (goal - value)/tau` to the part of `out` that belongs to the internal variables, with goals at the
    /// positions of `state`; see [`motile_scene::Body::add_implicit`].
    pub(crate) fn add_rate(
        &mut self,
        (positions, free): (&[Vec2], &[usize]),
        state: &[f64],
        factor: f64,
        out: &mut [f64],
    ) {
        let (places, values) = state.split_at(2 * free.len());
        self.place(positions, free, places);
        let out = &mut out[places.len()..];
        self.each_goal(&self.stage, |time, number, goal| {
            out[number] += factor / time.max(self.shortest) * (goal - values[number]);
        });
    }

    /// Replaces the internal variables in `state` by the solutions y of `y - factor (goal - y)/tau = state`; see
    /// [`motile_scene::Body::solve_implicit`].
    pub(crate) fn solve_rate(&mut self, (positions, free): (&[Vec2], &[usize]), factor: f64, state: &mut [f64]) {
        let (places, values) = state.split_at_mut(2 * free.len());
        self.place(positions, free, places);
        self.each_goal(&self.stage, |time, number, goal| {
            let value = &mut values[number];
            // As a mean of the two, which also holds where the ratio is infinite.
            *value += (goal - *value) / (1.0 + time.max(self.shortest) / factor);
        });
    }

    /// Remembers the internal variables and what they relax towards at the start of a step of `dt` (time).
    pub(crate) fn begin_step(&mut self, positions: &[Vec2], dt: f64) {
        self.shortest = SHORTEST * dt;
        let mut before = std::mem::take(&mut self.before);
        self.each_goal(positions, |_, number, goal| before[number] = [self.values[number], goal]);
        self.before = before;
    }

    /// Replaces the internal variables by the exact solution at the end of a step of `dt` (time) in which the goals
    /// change linearly, to those at `positions` (length):
    ///
    /// ```text
    /// q' = g' - exp(-z) (g - q) - (1 - exp(-z))/z (g' - g),   z = dt/tau
    /// ```
    pub(crate) fn end_step(&mut self, positions: &[Vec2], dt: f64) {
        let mut values = std::mem::take(&mut self.values);
        self.each_goal(positions, |time, number, goal| {
            let [value, first] = self.before[number];
            let ratio = dt / time;
            let mean = if ratio > 0.0 { -(-ratio).exp_m1() / ratio } else { 1.0 };
            values[number] = goal - (-ratio).exp() * (first - value) - mean * (goal - first);
        });
        self.values = values;
    }
}

/// Forces of a solid without elastic stress.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NoElasticity {
    /// Number of points of the mesh.
    pub(crate) points: usize,
    /// Number of its triangles.
    pub(crate) triangles: usize,
}

impl crate::ElasticForces for NoElasticity {
    fn point_count(&self) -> usize {
        self.points
    }

    fn add_forces(&self, _positions: &[Vec2], _forces: &mut [Vec2]) -> Result<(), SolidError> {
        Ok(())
    }

    fn energy(&self, _positions: &[Vec2]) -> Result<f64, SolidError> {
        Ok(0.0)
    }

    fn stress(&self, triangle: usize, _gradient: &Mat2) -> Option<Mat2> {
        (triangle < self.triangles).then_some(Mat2::ZERO)
    }

    fn stiffest(&self) -> Moduli {
        Moduli::springs_of_checked(0.0)
    }
}

#[cfg(test)]
mod tests;
