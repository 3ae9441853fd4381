//! Sine and cosine transforms across a channel at one wave number along it.

use std::f64::consts::PI;

use motile_base::{CosineTransform, InputError, NodeSineTransform, SineTransform};

/// Transforms across a channel, with one column of each unknown.
///
/// Lengths are in cells. The x velocity is multiplied by `i exp(i theta / 2)`, theta = 2 pi m / nx, which moves it to
/// the centres, so that divergence and gradient become real:
///
/// `div = k u + dv`, `grad phi = (-k phi, d phi)`, `k = 2 sin(theta / 2)`.
///
/// So real and imaginary parts of a wave number are two columns that have nothing to do with each other.
#[derive(Debug, Clone)]
pub(crate) struct Across {
    sines: SineTransform,
    nodes: NodeSineTransform,
    cosines: CosineTransform,
    /// `2 sin(pi n / (2 N))`, n = 0 to N: the symbol of the first difference.
    difference: Vec<f64>,
    /// `1 / (k^2 + difference^2)`, zero if that is infinite: minus the symbol of the inverse Laplacian.
    inverse: Vec<f64>,
    k: f64,
    /// Force, then intermediate velocity along x, in the cells.
    pub(crate) u: Vec<f64>,
    /// Force, then coefficients of the intermediate velocity along y, and finally its values on the inner nodes.
    pub(crate) v: Vec<f64>,
    /// Coefficients of the potential, and finally its values in the cells.
    pub(crate) phi: Vec<f64>,
}

impl Across {
    pub(crate) fn new(n: usize) -> Result<Self, InputError> {
        Ok(Self {
            sines: SineTransform::new(n)?,
            nodes: NodeSineTransform::new(n - 1)?,
            cosines: CosineTransform::new(n)?,
            difference: (0..=n).map(|k| 2.0 * (0.5 * PI * k as f64 / n as f64).sin()).collect(),
            inverse: vec![0.0; n + 1],
            k: 0.0,
            u: vec![0.0; n],
            v: vec![0.0; n - 1],
            phi: vec![0.0; n],
        })
    }

    /// Chooses the wave number.
    pub(crate) fn set_wave(&mut self, k: f64) {
        self.k = k;
        for (inverse, difference) in self.inverse.iter_mut().zip(&self.difference) {
            let laplacian = k * k + difference * difference;
            *inverse = if laplacian == 0.0 { 0.0 } else { 1.0 / laplacian };
        }
    }

    /// Returns `2 sin(theta / 2)` of the wave number.
    pub(crate) fn k(&self) -> f64 {
        self.k
    }

    /// Exchanges the columns of the velocity.
    pub(crate) fn swap(&mut self, u: &mut Vec<f64>, v: &mut Vec<f64>) {
        std::mem::swap(&mut self.u, u);
        std::mem::swap(&mut self.v, v);
    }

    /// Turns forces (over the viscosity) into the intermediate velocity that is zero on the walls, Cowley (2.22): `u`
    /// by DST-II and DST-III, `v` by DST-I, of which the way back is left to [`Across::finish_v`].
    pub(crate) fn diffuse(&mut self) {
        // Of all transforms the lengths are those planned for, so that no call can fail.
        let scale = 2.0 / self.u.len() as f64;
        let _ = self.sines.forward(&mut self.u);
        for (u, inverse) in self.u.iter_mut().zip(&self.inverse[1..]) {
            *u *= scale * inverse;
        }
        let _ = self.sines.inverse(&mut self.u);
        let _ = self.nodes.transform(&mut self.v);
        for (v, inverse) in self.v.iter_mut().zip(&self.inverse[1..]) {
            *v *= scale * inverse;
        }
    }

    /// Computes coefficients of the potential without slope at the walls, `lap phi = div v*`, Cowley (2.23), by DCT-II.
    pub(crate) fn project(&mut self) {
        let scale = 2.0 / self.u.len() as f64;
        self.phi.copy_from_slice(&self.u);
        let _ = self.cosines.forward(&mut self.phi);
        self.phi[0] *= -scale * self.k * self.inverse[0];
        let symbols = self.inverse[1..].iter().zip(&self.difference[1..]);
        for ((phi, v), (inverse, difference)) in self.phi[1..].iter_mut().zip(&self.v).zip(symbols) {
            *phi = -inverse * (scale * self.k * *phi + difference * v);
        }
    }

    /// Adds minus the slope of the potential to the coefficients of `v`, Cowley (2.29).
    pub(crate) fn correct_v(&mut self) {
        for ((v, phi), difference) in self.v.iter_mut().zip(&self.phi[1..]).zip(&self.difference[1..]) {
            *v += difference * phi;
        }
    }

    /// Replaces `u` by minus the Laplacian of the potential, which must still be coefficients.
    pub(crate) fn laplacian_into_u(&mut self) {
        for ((u, phi), difference) in self.u.iter_mut().zip(&self.phi).zip(&self.difference) {
            *u = (self.k * self.k + difference * difference) * phi;
        }
        let _ = self.cosines.inverse(&mut self.u);
    }

    /// Transforms the potential back, by DCT-III.
    pub(crate) fn finish_phi(&mut self) {
        let _ = self.cosines.inverse(&mut self.phi);
    }

    /// Transforms `v` back, by DST-I.
    pub(crate) fn finish_v(&mut self) {
        let _ = self.nodes.transform(&mut self.v);
    }
}
