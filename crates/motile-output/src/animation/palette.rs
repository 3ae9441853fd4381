//! Palette of an animation: the most frequent colours of all its frames.

use std::cmp::Reverse;

use crate::Rgb;

/// Returns the code of a colour: 5, 6 and 5 bits of red, green and blue.
pub(crate) fn code(Rgb([r, g, b]): Rgb) -> u16 {
    (u16::from(r >> 3) << 11) | (u16::from(g >> 2) << 5) | u16::from(b >> 3)
}

/// Histogram of colours: for each code the sum of the colours and their number.
#[derive(Debug, Clone)]
pub(crate) struct Histogram(Vec<([u64; 3], u64)>);

impl Histogram {
    pub(crate) fn new() -> Self {
        Self(vec![([0; 3], 0); 1 << 16])
    }

    pub(crate) fn add(&mut self, colour: Rgb) {
        let (sum, count) = &mut self.0[usize::from(code(colour))];
        *count += 1;
        sum.iter_mut().zip(colour.0).for_each(|(sum, channel)| *sum += u64::from(channel));
    }

    /// Returns the palette of the `size` (at most 256) most frequent colours, and for each code counted the index of
    /// the nearest of them. Left out are mixtures at the edges of lines, most of which occur a few times only.
    pub(crate) fn palette(&self, size: usize) -> (Vec<Rgb>, Vec<u8>) {
        let mut used: Vec<usize> = (0..self.0.len()).filter(|&k| self.0[k].1 > 0).collect();
        used.sort_by_key(|&k| Reverse(self.0[k].1));
        let mean = |k: usize| Rgb(self.0[k].0.map(|sum| ((sum + self.0[k].1 / 2) / self.0[k].1) as u8));
        let palette: Vec<Rgb> = used.iter().take(size).map(|&k| mean(k)).collect();
        let mut index = vec![0; self.0.len()];
        for (rank, k) in used.into_iter().enumerate() {
            let colour = mean(k);
            let distance = |n: &usize| -> u32 {
                palette[*n].0.into_iter().zip(colour.0).map(|(a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
            };
            index[k] = if rank < size { rank } else { (0..size).min_by_key(distance).unwrap_or(0) } as u8;
        }
        (palette, index)
    }
}

#[cfg(test)]
mod tests;
