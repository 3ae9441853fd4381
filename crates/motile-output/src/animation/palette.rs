//! The palette of an animation: the 255 colours that serve all its frames best.

use crate::Rgb;

/// A colour reduced to 5, 6 and 5 bits of red, green and blue.
pub(crate) fn code(Rgb([r, g, b]): Rgb) -> u16 {
    (u16::from(r >> 3) << 11) | (u16::from(g >> 2) << 5) | u16::from(b >> 3)
}

/// Sum of the colours of one code and their number.
#[derive(Debug, Clone, Copy, Default)]
struct Bin {
    sum: [u64; 3],
    count: u64,
}

impl Bin {
    fn mean(&self) -> [f64; 3] {
        self.sum.map(|s| s as f64 / self.count.max(1) as f64)
    }

    /// Weight in the choice of colours: less than proportional to the number of pixels, so that large plain areas do
    /// not take the colours of lines and text.
    fn weight(&self) -> f64 {
        (self.count as f64).sqrt()
    }
}

/// Counts colours.
#[derive(Debug, Clone)]
pub(crate) struct Histogram(Vec<Bin>);

impl Histogram {
    pub(crate) fn new() -> Self {
        Self(vec![Bin::default(); 1 << 16])
    }

    pub(crate) fn add(&mut self, colour: Rgb) {
        let bin = &mut self.0[usize::from(code(colour))];
        bin.count += 1;
        for (sum, channel) in bin.sum.iter_mut().zip(colour.0) {
            *sum += u64::from(channel);
        }
    }

    /// At most `size` colours, and for each code counted the index of the nearest of them.
    ///
    /// The set of colours is cut in two again and again, each time where the weighted squared distance from the mean
    /// is largest, at the mean along the longest axis.
    pub(crate) fn palette(&self, size: usize) -> (Vec<Rgb>, Vec<u8>) {
        let used: Vec<usize> = (0..self.0.len()).filter(|&k| self.0[k].count > 0).collect();
        let mut cells = vec![Cell::new(self, used.clone())];
        while cells.len() < size.min(256) {
            let worst = (0..cells.len()).max_by(|&a, &b| cells[a].error.total_cmp(&cells[b].error));
            let Some(worst) = worst.filter(|&k| cells[k].error > 0.0) else { break };
            let cell = cells.swap_remove(worst);
            let (low, high) = cell.members.iter().partition(|&&k| self.0[k].mean()[cell.axis] < cell.mean[cell.axis]);
            cells.extend([low, high].map(|members| Cell::new(self, members)));
        }
        let mut index = vec![0; self.0.len()];
        for k in used {
            let colour = self.0[k].mean();
            let distance = |cell: &Cell| (0..3).map(|c| (cell.mean[c] - colour[c]).powi(2)).sum::<f64>();
            let nearest = (0..cells.len()).min_by(|&a, &b| distance(&cells[a]).total_cmp(&distance(&cells[b])));
            index[k] = nearest.and_then(|n| u8::try_from(n).ok()).unwrap_or(0);
        }
        (cells.iter().map(|cell| Rgb(cell.mean.map(|v| v.round() as u8))).collect(), index)
    }
}

/// A set of colours.
struct Cell {
    members: Vec<usize>,
    mean: [f64; 3],
    /// Axis of the largest squared distance from the mean, and that.
    axis: usize,
    error: f64,
}

impl Cell {
    fn new(histogram: &Histogram, members: Vec<usize>) -> Self {
        let (mut mean, mut weight) = ([0.0; 3], 0.0);
        for bin in members.iter().map(|&k| &histogram.0[k]) {
            weight += bin.weight();
            for (m, v) in mean.iter_mut().zip(bin.mean()) {
                *m += bin.weight() * v;
            }
        }
        mean = mean.map(|m| m / f64::max(weight, 1.0));
        let mut errors = [0.0; 3];
        for bin in members.iter().map(|&k| &histogram.0[k]) {
            for (axis, error) in errors.iter_mut().enumerate() {
                *error += bin.weight() * (bin.mean()[axis] - mean[axis]).powi(2);
            }
        }
        let axis = (0..3).max_by(|&a, &b| errors[a].total_cmp(&errors[b])).unwrap_or(0);
        // Sets of one cannot be cut.
        let error = if members.len() > 1 { errors[axis] } else { 0.0 };
        Self { members, mean, axis, error }
    }
}

#[cfg(test)]
mod tests;
