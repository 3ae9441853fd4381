//! Points between walls with their factors in sums over modes.

use std::f64::consts::TAU;

use num_complex::Complex64;

use crate::shares;

/// Modes in one pass of a loop, as many as a vector register of AVX has numbers.
pub(crate) const LANES: usize = 4;

pub(crate) type Lanes = [f64; LANES];

/// `exp(-n k s) exp(i n k x)` for the first modes n = 1 .. 4 and the factor to the next four, for one wall.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Powers {
    /// Distance from the wall (length).
    pub(crate) distance: f64,
    pub(crate) re: Lanes,
    pub(crate) im: Lanes,
    step: Complex64,
}

impl Powers {
    fn new(k: f64, distance: f64, phase: Complex64) -> Self {
        let base = phase * (-k * distance).exp();
        let (mut re, mut im) = ([0.0; LANES], [0.0; LANES]);
        let mut power = Complex64::new(1.0, 0.0);
        for lane in 0..LANES {
            power *= base;
            (re[lane], im[lane]) = (power.re, power.im);
        }
        Self { distance, re, im, step: power }
    }

    /// Goes on to the next modes.
    #[inline(always)]
    pub(crate) fn advance(&mut self) {
        for lane in 0..LANES {
            let (re, im) = (self.re[lane], self.im[lane]);
            self.re[lane] = re * self.step.re - im * self.step.im;
            self.im[lane] = re * self.step.im + im * self.step.re;
        }
    }
}

/// Points between the walls with the factors of their first modes.
#[derive(Debug, Clone)]
pub(crate) struct WallPoints {
    /// 2 pi / period (1/length).
    k: f64,
    /// Half the distance between the walls (length).
    half: f64,
    /// Upper wall, lower wall.
    pub(crate) sides: [Vec<Powers>; 2],
    x: Vec<f64>,
    /// Height above the middle (length).
    pub(crate) y: Vec<f64>,
}

impl WallPoints {
    /// Creates no points, in a channel with this period and this half of its width (length).
    pub(crate) fn new(period: f64, half: f64) -> Self {
        Self { k: TAU / period, half, sides: Default::default(), x: Vec::new(), y: Vec::new() }
    }

    /// Removes all points, keeping the memory.
    pub(crate) fn clear(&mut self) {
        self.sides.iter_mut().for_each(Vec::clear);
        self.x.clear();
        self.y.clear();
    }

    /// Adds a point at x and y above the middle (length), before [`WallPoints::prepare`].
    pub(crate) fn push(&mut self, x: f64, y: f64) {
        self.x.push(x);
        self.y.push(y);
    }

    /// Computes the factors of all points.
    pub(crate) fn prepare(&mut self) {
        let Self { k, half, sides: [upper, lower], x, y } = self;
        for side in [&mut *upper, lower] {
            side.resize(x.len(), Powers::default());
        }
        let len = shares::length(x.len());
        let places = x.chunks(len).zip(y.chunks(len));
        shares::each_of(
            x.len(),
            upper.chunks_mut(len).zip(lower.chunks_mut(len)).zip(places),
            |((upper, lower), (x, y))| {
                for (((upper, lower), x), y) in upper.iter_mut().zip(lower.iter_mut()).zip(*x).zip(*y) {
                    let phase = Complex64::cis(*k * x);
                    *upper = Powers::new(*k, *half - y, phase);
                    *lower = Powers::new(*k, *half + y, phase);
                }
            },
        );
    }

    /// Returns the smallest distance of a point from a wall (length), infinite without points.
    pub(crate) fn gap(&self) -> f64 {
        self.sides.iter().flatten().map(|p| p.distance).fold(f64::INFINITY, f64::min)
    }
}
