//! Points between walls, prepared for sums over modes.

use num_complex::Complex64;

use super::WallModes;

/// Modes done at a time.
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
    pub(crate) fn new(k: f64, distance: f64, phase: Complex64) -> Self {
        let base = phase * (-k * distance).exp();
        let (mut re, mut im) = ([0.0; LANES], [0.0; LANES]);
        let mut power = Complex64::new(1.0, 0.0);
        for lane in 0..LANES {
            power *= base;
            (re[lane], im[lane]) = (power.re, power.im);
        }
        Self { distance, re, im, step: power }
    }

    #[inline(always)]
    pub(crate) fn advance(&mut self) {
        for lane in 0..LANES {
            let (re, im) = (self.re[lane], self.im[lane]);
            self.re[lane] = re * self.step.re - im * self.step.im;
            self.im[lane] = re * self.step.im + im * self.step.re;
        }
    }
}

/// Points between the walls, prepared for sums over modes.
#[derive(Debug, Clone, Default)]
pub(crate) struct WallPoints {
    /// Upper wall, lower wall.
    pub(crate) sides: [Vec<Powers>; 2],
    /// Height above the middle (length).
    pub(crate) y: Vec<f64>,
}

impl WallPoints {
    /// Removes all points, keeping the memory.
    pub(crate) fn clear(&mut self) {
        self.sides.iter_mut().for_each(Vec::clear);
        self.y.clear();
    }

    /// Adds a point at x and y above the middle.
    pub(crate) fn push(&mut self, modes: &WallModes, x: f64, y: f64) {
        let phase = Complex64::cis(modes.k * x);
        self.sides[0].push(Powers::new(modes.k, modes.half - y, phase));
        self.sides[1].push(Powers::new(modes.k, modes.half + y, phase));
        self.y.push(y);
    }

    /// Smallest distance of a point from a wall (length), infinite without points.
    pub(crate) fn gap(&self) -> f64 {
        self.sides.iter().flatten().map(|p| p.distance).fold(f64::INFINITY, f64::min)
    }
}
