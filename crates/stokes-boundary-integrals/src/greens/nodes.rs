//! Coordinates and vectors at nodes as arrays of components, for sums over pairs in vector registers.

use num_complex::Complex64;

/// Coordinates of the nodes of a curve with their circular and exponential functions. Every array is stored twice in a
/// row, so that a cyclic shift is a slice.
#[derive(Debug, Clone, Default)]
pub(crate) struct Nodes {
    nodes: usize,
    x: Vec<f64>,
    y: Vec<f64>,
    sin: Vec<f64>,
    cos: Vec<f64>,
    up: Vec<f64>,
    down: Vec<f64>,
}

/// A cyclic stretch of [`Nodes`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Window<'a> {
    /// x relative to the centre of the curve (length).
    pub(crate) x: &'a [f64],
    /// y relative to the centre (length).
    pub(crate) y: &'a [f64],
    /// sin(k x/2).
    pub(crate) sin: &'a [f64],
    /// cos(k x/2).
    pub(crate) cos: &'a [f64],
    /// exp(k y/2).
    pub(crate) up: &'a [f64],
    /// exp(-k y/2).
    pub(crate) down: &'a [f64],
}

impl Nodes {
    /// Takes over positions (length) relative to the centre of a curve. `wave` is k = 2 pi/period (1/length) of a row
    /// of images along x; without one, only x and y are computed.
    pub(crate) fn fill(&mut self, positions: &[Complex64], wave: Option<f64>) {
        self.nodes = positions.len();
        let arrays = [&mut self.x, &mut self.y, &mut self.sin, &mut self.cos, &mut self.up, &mut self.down];
        for array in arrays {
            array.resize(2 * positions.len(), 0.0);
        }
        let n = self.nodes;
        for (i, z) in positions.iter().enumerate() {
            (self.x[i], self.y[i]) = (z.re, z.im);
            if let Some(k) = wave {
                (self.sin[i], self.cos[i]) = (0.5 * k * z.re).sin_cos();
                self.up[i] = (0.5 * k * z.im).exp();
                self.down[i] = 1.0 / self.up[i];
            }
        }
        let arrays = [&mut self.x, &mut self.y, &mut self.sin, &mut self.cos, &mut self.up, &mut self.down];
        for array in arrays {
            array.copy_within(..n, n);
        }
    }

    /// Returns the number of nodes.
    pub(crate) fn len(&self) -> usize {
        self.nodes
    }

    /// Returns the `count` nodes from `start` on, which is below the number of nodes.
    #[inline(always)]
    pub(crate) fn window(&self, start: usize, count: usize) -> Window<'_> {
        let range = start..start + count;
        Window {
            x: &self.x[range.clone()],
            y: &self.y[range.clone()],
            sin: &self.sin[range.clone()],
            cos: &self.cos[range.clone()],
            up: &self.up[range.clone()],
            down: &self.down[range],
        }
    }
}

/// A vector at each node as two arrays, stored twice in a row like [`Nodes`].
#[derive(Debug, Default, Clone)]
pub(crate) struct Vectors {
    pub(crate) x: Vec<f64>,
    pub(crate) y: Vec<f64>,
}

impl Vectors {
    /// Takes over complex numbers x + i y.
    pub(crate) fn fill(&mut self, values: &[Complex64]) {
        let n = values.len();
        self.x.resize(2 * n, 0.0);
        self.y.resize(2 * n, 0.0);
        for (i, value) in values.iter().enumerate() {
            (self.x[i], self.y[i]) = (value.re, value.im);
        }
        self.x.copy_within(..n, n);
        self.y.copy_within(..n, n);
    }

    /// Takes over components.
    pub(crate) fn copy(&mut self, components: [&[f64]; 2]) {
        for (array, values) in [&mut self.x, &mut self.y].into_iter().zip(components) {
            array.clear();
            array.extend_from_slice(values);
            array.extend_from_slice(values);
        }
    }

    /// Sets `len` entries to zero.
    pub(crate) fn clear(&mut self, len: usize) {
        for array in [&mut self.x, &mut self.y] {
            array.clear();
            array.resize(len, 0.0);
        }
    }
}
