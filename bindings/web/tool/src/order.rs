//! Order of the functions of a compiled module.
//!
//! Compression looks back 32 kilobytes, a compiled module has a hundred times as many, and generic code in it comes
//! again and again: functions that are alike stand side by side here.

use std::collections::{HashMap, VecDeque};

/// Bytes that a compressor looks back.
const WINDOW: usize = 32_768;
/// Length of the pieces by which functions are compared (bytes).
const PIECE: usize = 6;
/// Piece in so many that is looked at.
const SAMPLE: u32 = 4;
/// Functions with a piece from which on it tells nothing.
const COMMON: usize = 1000;

/// Order in which each function shares as much as can be had with those before it, the largest first.
pub(crate) fn alike(bodies: &[&[u8]]) -> Vec<usize> {
    let pieces: Vec<Vec<u32>> = bodies.iter().map(|body| pieces(body)).collect();
    let mut holders: HashMap<u32, Vec<usize>> = HashMap::new();
    for (function, pieces) in pieces.iter().enumerate() {
        pieces.iter().for_each(|&piece| holders.entry(piece).or_default().push(function));
    }
    holders.retain(|_, functions| (2..COMMON).contains(&functions.len()));

    let mut left: Vec<usize> = (0..bodies.len()).collect();
    left.sort_by_key(|&function| std::cmp::Reverse(bodies[function].len()));
    // Pieces of each function that the window has, and how often it has each.
    let mut shared = vec![0_u32; bodies.len()];
    let mut counts: HashMap<u32, u32> = HashMap::new();
    let (mut window, mut length) = (VecDeque::new(), 0);
    let mut order = Vec::new();
    while !left.is_empty() {
        let likeness = |&function: &usize| f64::from(shared[function]) / (pieces[function].len() as f64 + 4.0);
        let mut best = 0;
        let mut most = 0.0;
        for (place, function) in left.iter().enumerate() {
            let value = likeness(function);
            if value > most {
                (best, most) = (place, value);
            }
        }
        let next = left.remove(best);
        order.push(next);
        window.push_back(next);
        length += bodies[next].len();
        for piece in &pieces[next] {
            let Some(functions) = holders.get(piece) else { continue };
            let count = counts.entry(*piece).or_default();
            if *count == 0 {
                functions.iter().for_each(|&function| shared[function] += 1);
            }
            *count += 1;
        }
        while length > WINDOW && window.len() > 1 {
            let Some(gone) = window.pop_front() else { break };
            length -= bodies[gone].len();
            for piece in &pieces[gone] {
                let (Some(functions), Some(count)) = (holders.get(piece), counts.get_mut(piece)) else { continue };
                *count -= 1;
                if *count == 0 {
                    functions.iter().for_each(|&function| shared[function] -= 1);
                }
            }
        }
    }
    order
}

/// Sample of the pieces of a function, as hashes, each once.
fn pieces(body: &[u8]) -> Vec<u32> {
    let hash =
        |piece: &[u8]| piece.iter().fold(0x811c_9dc5_u32, |hash, &b| (hash ^ u32::from(b)).wrapping_mul(16_777_619));
    let mut pieces: Vec<u32> =
        body.windows(PIECE).map(hash).filter(|hash| (hash >> 7).is_multiple_of(SAMPLE)).collect();
    pieces.sort_unstable();
    pieces.dedup();
    pieces
}
