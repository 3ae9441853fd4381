//! Places along an outline by their arc length.

use ib_core::Vec2;

use super::Outline;
use super::piece::Piece;

/// A place on an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Place {
    /// Run of smooth pieces from one corner to the next.
    chain: usize,
    /// Arc length from the start of the run.
    along: f64,
    corner: bool,
}

/// An outline cut at its corners.
#[derive(Debug)]
pub(crate) struct Track<'a> {
    chains: Vec<Chain<'a>>,
    /// Added to x after one turn.
    period: f64,
    closed: bool,
    /// Without a corner the one run has no end.
    endless: bool,
}

/// A run of pieces that join smoothly.
#[derive(Debug)]
struct Chain<'a> {
    links: Vec<Link<'a>>,
    length: f64,
}

/// A piece of a run.
#[derive(Debug)]
struct Link<'a> {
    piece: &'a Piece,
    /// Added to its x.
    shift: f64,
    /// Arc length of the run before it.
    start: f64,
}

impl<'a> Track<'a> {
    /// Without a corner the one run starts at the first piece.
    pub(crate) fn new(outline: &'a Outline) -> Self {
        let count = outline.pieces.len();
        let period = outline.period.unwrap_or(0.0);
        let corner = (0..count).find(|&k| outline.is_corner(k));
        let first = corner.unwrap_or(0);
        let mut chains: Vec<Chain<'a>> = Vec::new();
        for step in first..first + count {
            let k = step % count;
            let (piece, shift) = (&outline.pieces[k], if step < count { 0.0 } else { period });
            match chains.last_mut() {
                Some(chain) if !outline.is_corner(k) => {
                    chain.links.push(Link { piece, shift, start: chain.length });
                    chain.length += piece.length();
                }
                _ => chains.push(Chain { links: vec![Link { piece, shift, start: 0.0 }], length: piece.length() }),
            }
        }
        Self { chains, period, closed: outline.period.is_none(), endless: corner.is_none() }
    }

    /// Places at about `spacing` (length), equally spaced between corners, corners among them. Without a corner they
    /// start with the fraction `phase` of a spacing.
    pub(crate) fn places(&self, spacing: f64, phase: f64) -> Vec<Place> {
        let phase = if self.endless { phase } else { 0.0 };
        // A closed line of one or two smooth parts needs points in between to enclose an area.
        let least = if self.closed { 3_usize.div_ceil(self.chains.len()) } else { 1 };
        let mut places = Vec::new();
        for (number, chain) in self.chains.iter().enumerate() {
            let count = ((chain.length / spacing).round() as usize).max(least);
            places.extend((0..count).map(|k| Place {
                chain: number,
                along: chain.length * (k as f64 + phase) / count as f64,
                corner: k == 0 && !self.endless,
            }));
        }
        places
    }

    /// The place `by` (length) further along, not beyond the next corner; corners stay.
    pub(crate) fn moved(&self, place: Place, by: f64) -> Place {
        let along = match place {
            Place { corner: true, along, .. } => along,
            Place { along, .. } if self.endless => along + by,
            Place { along, .. } => (along + by).clamp(0.0, self.chains[place.chain].length),
        };
        Place { along, ..place }
    }

    /// The point of the exact outline at a place (length).
    pub(crate) fn at(&self, place: Place) -> Vec2 {
        let chain = &self.chains[place.chain];
        let turns = if self.endless { (place.along / chain.length).floor() } else { 0.0 };
        let along = place.along - turns * chain.length;
        let link = &chain.links[chain.links.partition_point(|link| link.start <= along).max(1) - 1];
        link.piece.at(along - link.start) + Vec2::new(link.shift + turns * self.period, 0.0)
    }
}
