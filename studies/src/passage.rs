//! Fate of a droplet that meets a constriction.

use motile::active_interface::{ActiveDroplet, polygon_moments};
use motile::scene::{Hydrodynamics, Observer, System};

use motile_cli::run::Decided;

/// How far back from the furthest it has come a droplet counts as turned back (R0).
const BACK: f64 = 1.0;
/// A droplet is stuck that has stayed within this distance (R0) for this time, four times R0^2/D.
const REST: (f64, f64) = (0.02, 40.0);

/// Fate of a droplet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// Its centroid is beyond the far end of the constriction.
    Passed,
    /// The droplet has come back by its radius from where it was furthest.
    TurnedBack,
    /// The droplet has stayed in its place.
    Stuck,
    /// None of this, yet.
    Undecided,
}

/// Follows the first droplet of a scene to the far end of a constriction, or wherever else it goes. To be called after
/// every step; ends the run by the error [`Decided`].
#[derive(Debug, Clone)]
pub(crate) struct Passage {
    far_end: f64,
    /// When the droplet was first looked at.
    start: f64,
    /// Its latest places, as far back as it has to rest.
    track: Vec<(f64, f64)>,
    furthest: f64,
    verdict: Verdict,
}

/// Name of the record of a passage: start, furthest x, and the track.
const RECORD: &str = "passage";

impl Passage {
    /// For a constriction that ends at `far_end` (R0), on the right of a droplet that starts on its left.
    pub(crate) fn new(far_end: f64) -> Self {
        let (start, furthest, verdict) = (f64::NAN, f64::NEG_INFINITY, Verdict::Undecided);
        Self { far_end, start, track: Vec::new(), furthest, verdict }
    }

    /// The verdict.
    pub(crate) fn verdict(&self) -> Verdict {
        self.verdict
    }

    /// When it was found, or until when it was not.
    pub(crate) fn time(&self) -> f64 {
        self.track.last().map_or(0.0, |(time, _)| *time)
    }

    /// Takes the centroid at a time into account.
    pub(crate) fn follow(&mut self, time: f64, x: f64) {
        let (near, long) = REST;
        self.start = if self.track.is_empty() { time } else { self.start };
        self.furthest = self.furthest.max(x);
        self.track.push((time, x));
        self.track.drain(..self.track.partition_point(|(t, _)| *t < time - long));
        let rested = time - self.start >= long && {
            let late = self.track.iter().map(|(_, x)| *x);
            let (low, high) = late.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
            high - low < near
        };
        self.verdict = if x > self.far_end {
            Verdict::Passed
        } else if x < self.furthest - BACK {
            Verdict::TurnedBack
        } else if rested {
            Verdict::Stuck
        } else {
            Verdict::Undecided
        };
    }
}

impl<H: Hydrodynamics> Observer<H> for Passage {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        let (_, droplet) = system.bodies::<ActiveDroplet>().next().ok_or("a scene without a droplet")?;
        let x = polygon_moments(droplet.markers())?.centroid.x;
        let (time, kept) = (system.time(), &mut system.record_mut(RECORD).numbers);
        if let (true, [start, furthest, track @ ..]) = (self.track.is_empty(), kept.as_slice()) {
            // From before the checkpoint that the run goes on from.
            (self.start, self.furthest) = (*start, *furthest);
            self.track = track.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect();
        }
        // A second look at the same time, where a run starts.
        if self.track.last().is_none_or(|(last, _)| *last < time) {
            self.follow(time, x);
        }
        kept.clear();
        kept.extend([self.start, self.furthest]);
        kept.extend(self.track.iter().flat_map(|(time, x)| [time, x]));
        if self.verdict == Verdict::Undecided { Ok(()) } else { Err(Decided.into()) }
    }
}

#[cfg(test)]
mod tests;
