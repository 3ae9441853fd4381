//! Fourier transforms between the points that a curve is given by, its nodes and its fine nodes.

use motile_base::{
    ComplexTransform, InputError, Vec2,
    internal::spectrum::{copy_band, largest_wave},
};
use num_complex::Complex64;

/// Fine nodes per node, where a flow is needed close to a curve. Products of a force or velocity with the tangent have
/// twice the modes that nodes carry; four times the nodes leave as many modes again for the quotient by a pole.
pub(crate) const REFINEMENT: usize = 4;

/// Forward and inverse transforms of one length with their scratch. The forward one carries the factor 1/length, so
/// that it gives Fourier coefficients.
#[derive(Debug, Clone)]
pub(crate) struct Transform(ComplexTransform);

impl Transform {
    pub(crate) fn new(len: usize) -> Result<Self, InputError> {
        ComplexTransform::new(len).map(Self)
    }

    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// Turns samples into Fourier coefficients, in place.
    pub(crate) fn forward(&mut self, buffer: &mut [Complex64]) {
        // Buffers have the length of the plan, so that the call cannot fail.
        let _ = self.0.forward(buffer);
        let factor = 1.0 / buffer.len() as f64;
        buffer.iter_mut().for_each(|value| *value *= factor);
    }

    /// Turns Fourier coefficients into samples, in place.
    pub(crate) fn inverse(&mut self, buffer: &mut [Complex64]) {
        let _ = self.0.inverse(buffer);
    }
}

/// Transforms between points, nodes and fine nodes, shared by all curves of that many nodes.
#[derive(Debug, Clone)]
pub(crate) struct Transforms {
    pub(crate) nodes: Transform,
    pub(crate) fine: Transform,
    finer: Vec<Transform>,
    points: Vec<Transform>,
    buffer: Vec<Complex64>,
    spectrum: Vec<Complex64>,
}

impl Transforms {
    pub(crate) fn new(nodes: usize) -> Result<Self, InputError> {
        Ok(Self {
            nodes: Transform::new(nodes)?,
            fine: Transform::new(REFINEMENT.saturating_mul(nodes))?,
            finer: Vec::new(),
            points: Vec::new(),
            buffer: Vec::new(),
            spectrum: vec![Complex64::default(); nodes],
        })
    }

    /// Returns the transform of the values at so many nodes in place of each node, made at the first use of a number.
    pub(crate) fn finer(&mut self, factor: usize) -> Result<&mut Transform, InputError> {
        let len = factor.saturating_mul(self.nodes.len());
        let known = self.finer.iter().position(|plan| plan.len() == len);
        if known.is_none() {
            self.finer.push(Transform::new(len)?);
        }
        let index = known.unwrap_or(self.finer.len() - 1);
        Ok(&mut self.finer[index])
    }

    /// Returns the transform of `len` values at points with a buffer of that length, made at the first use of a length.
    fn points(&mut self, len: usize) -> Result<(&mut Transform, &mut [Complex64]), InputError> {
        let known = self.points.iter().position(|plan| plan.len() == len);
        if known.is_none() {
            self.points.push(Transform::new(len)?);
        }
        let index = known.unwrap_or(self.points.len() - 1);
        self.buffer.resize(self.buffer.len().max(len), Complex64::default());
        Ok((&mut self.points[index], &mut self.buffer[..len]))
    }

    /// Fourier coefficients of values at points, truncated to the modes that nodes carry; `gain` is the advance of the
    /// values in a turn of the parameter, which is subtracted as a linear function.
    pub(crate) fn analyse(
        &mut self,
        values: &[Vec2],
        gain: Complex64,
        out: &mut [Complex64],
    ) -> Result<(), InputError> {
        let (plan, buffer) = self.points(values.len())?;
        let step = gain / values.len() as f64;
        for (k, (slot, value)) in buffer.iter_mut().zip(values).enumerate() {
            *slot = Complex64::new(value.x, value.y) - step * k as f64;
        }
        plan.forward(buffer);
        copy_band(buffer, out, largest_wave(out.len()));
        Ok(())
    }

    /// Returns the values at nodes, x then y, from values at points.
    pub(crate) fn at_nodes(&mut self, values: &[Vec2], out: &mut [f64]) -> Result<(), InputError> {
        let mut spectrum = std::mem::take(&mut self.spectrum);
        self.analyse(values, Complex64::default(), &mut spectrum)?;
        self.nodes.inverse(&mut spectrum);
        let (x, y) = out.split_at_mut(spectrum.len());
        for ((x, y), value) in x.iter_mut().zip(y).zip(&spectrum) {
            (*x, *y) = (value.re, value.im);
        }
        self.spectrum = spectrum;
        Ok(())
    }

    /// Fourier coefficients of values at nodes, x then y.
    pub(crate) fn coefficients(&mut self, values: &[f64]) -> &[Complex64] {
        let (x, y) = values.split_at(self.spectrum.len());
        for ((value, x), y) in self.spectrum.iter_mut().zip(x).zip(y) {
            *value = Complex64::new(*x, *y);
        }
        self.nodes.forward(&mut self.spectrum);
        &self.spectrum
    }

    /// Returns the values at points from values at nodes, x then y.
    pub(crate) fn at_points(&mut self, values: &[f64], out: &mut [Vec2]) -> Result<(), InputError> {
        self.coefficients(values);
        let spectrum = std::mem::take(&mut self.spectrum);
        let (plan, buffer) = self.points(out.len())?;
        copy_band(&spectrum, buffer, largest_wave(spectrum.len()));
        plan.inverse(buffer);
        for (out, value) in out.iter_mut().zip(buffer) {
            *out = Vec2::new(value.re, value.im);
        }
        self.spectrum = spectrum;
        Ok(())
    }

    /// Returns the values at fine nodes from values at nodes, x then y.
    pub(crate) fn at_fine(&mut self, values: &[f64], out: &mut [Complex64]) {
        copy_band(self.coefficients(values), out, largest_wave(values.len() / 2));
        self.fine.inverse(out);
    }

    /// Returns the values at so many nodes in place of each node, from values at nodes, x then y.
    pub(crate) fn at_finer(&mut self, factor: usize, values: &[f64], out: &mut [Complex64]) -> Result<(), InputError> {
        copy_band(self.coefficients(values), out, largest_wave(values.len() / 2));
        self.finer(factor)?.inverse(out);
        Ok(())
    }
}
