//! Points between walls with their factors in sums over modes.

use std::f64::consts::TAU;

use num_complex::Complex64;

/// Modes in one pass of a loop, as many as a vector register of AVX has numbers.
pub(crate) const LANES: usize = 4;

pub(crate) type Lanes = [f64; LANES];

/// `exp(-n k s) exp(i n k x)` for the first modes n = 1 .. 4 and the factor to the next four, for one wall.
#[derive(Debug, Clone, Copy)]
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
    /// Height above the middle (length).
    pub(crate) y: Vec<f64>,
}

impl WallPoints {
    /// No points, in a channel with this period and this half of its width (length).
    pub(crate) fn new(period: f64, half: f64) -> Self {
        Self { k: TAU / period, half, sides: Default::default(), y: Vec::new() }
    }

    /// Removes all points, keeping the memory.
    pub(crate) fn clear(&mut self) {
        self.sides.iter_mut().for_each(Vec::clear);
        self.y.clear();
    }

    /// Adds a point at x and y above the middle (length).
    pub(crate) fn push(&mut self, x: f64, y: f64) {
        let phase = Complex64::cis(self.k * x);
        self.sides[0].push(Powers::new(self.k, self.half - y, phase));
        self.sides[1].push(Powers::new(self.k, self.half + y, phase));
        self.y.push(y);
    }

    /// Smallest distance of a point from a wall (length), infinite without points.
    pub(crate) fn gap(&self) -> f64 {
        self.sides.iter().flatten().map(|p| p.distance).fold(f64::INFINITY, f64::min)
    }
}
