//! The fields that an interface feels, and their values on it.

use motile_base::Vec2;

use super::Field;
use crate::InterfaceError;

/// The fields that an interface feels, each added to what it has by itself; `None` for none.
#[derive(Debug, Clone, Default)]
pub struct Fields {
    /// Field that is added to the tension (force; in three dimensions force per length).
    pub tension: Option<Field>,
    /// Field that is added to the activity zeta (force times length; in three dimensions force times length squared),
    /// so that the tension changes by minus it times the concentration.
    pub activity: Option<Field>,
    /// Field that is added to the rate of binding k_on (length per time).
    pub binding: Option<Field>,
    /// Field that is added to the rate of unbinding k_off (1/time).
    pub unbinding: Option<Field>,
    /// Field that is added to the friction xi with a substrate (force times time per length squared).
    pub friction: Option<Field>,
}

impl Fields {
    /// Returns the fields with names for messages.
    pub(crate) fn named(&self) -> impl Iterator<Item = (&'static str, &Field)> {
        let Self { tension, activity, binding, unbinding, friction } = self;
        let names = [
            ("tension", tension),
            ("activity", activity),
            ("binding", binding),
            ("unbinding", unbinding),
            ("friction", friction),
        ];
        names.into_iter().filter_map(|(name, field)| Some((name, field.as_ref()?)))
    }

    /// Returns true if there is no field.
    #[must_use]
    pub fn is_none(&self) -> bool {
        self.named().next().is_none()
    }

    pub(crate) fn depends_on_time(&self) -> bool {
        self.named().any(|(_, field)| field.depends_on_time())
    }

    /// Returns the highest angular frequency of the fields (radians per time).
    pub(crate) fn highest_frequency(&self) -> f64 {
        self.named().map(|(_, field)| field.highest_frequency()).fold(0.0, f64::max)
    }
}

/// Fields with their values on the segments of an interface.
#[derive(Debug, Clone, Default)]
pub(crate) struct Felt {
    pub(crate) fields: Fields,
    /// Time of the present state (time).
    pub(crate) time: f64,
    /// Middles of the segments (length).
    pub(crate) middles: Vec<Vec2>,
    /// Additions to the tensions of the segments (force).
    pub(crate) tensions: Vec<f64>,
    /// Additions to the activity on the segments; empty without such a field.
    pub(crate) activities: Vec<f64>,
    /// Rates of binding and unbinding that are added on the segments, as of the last [`Felt::rates`].
    binding: Vec<f64>,
    unbinding: Vec<f64>,
    places: Vec<Vec2>,
    /// Particles that bind in an implicit step, for a solve.
    bound: Vec<f64>,
}

impl Felt {
    pub(crate) fn new(fields: Fields) -> Self {
        Self { fields, ..Self::default() }
    }

    /// Adds what the fields make of the tensions of segments, whose middles are known.
    pub(crate) fn add_tensions(&mut self, concentrations: &[f64], tensions: &mut [f64]) {
        let time = self.time;
        self.tensions.clear();
        let field = self.fields.tension.as_ref();
        let value = |&place: &Vec2| field.map_or(0.0, |field| field.value(place, time));
        self.tensions.extend(self.middles.iter().map(value));
        if let Some(field) = &self.fields.activity {
            self.activities.clear();
            self.activities.extend(self.middles.iter().map(|&place| field.value(place, time)));
            for ((tension, activity), c) in self.tensions.iter_mut().zip(&self.activities).zip(concentrations) {
                *tension -= activity * c;
            }
        }
        tensions.iter_mut().zip(&self.tensions).for_each(|(tension, felt)| *tension += felt);
    }

    /// Computes the rates of binding and unbinding that are added on the segments between `positions` (x and y of each
    /// marker). There are none where the fields take away all of `base`. Returns the two lists, and a list to work
    /// with.
    pub(crate) fn rates(&mut self, positions: &[f64], base: [f64; 2]) -> ([&[f64]; 2], &mut Vec<f64>) {
        let Self { fields, time, binding, unbinding, places, bound, .. } = self;
        let markers = positions.chunks_exact(2).map(|pair| Vec2::new(pair[0], pair[1]));
        places.clear();
        places.extend(markers);
        middles_of(places, 0.0, true);
        let lists = [(binding, &fields.binding, base[0]), (unbinding, &fields.unbinding, base[1])];
        let rates = lists.map(|(list, field, base)| {
            list.clear();
            let rate = |&place: &Vec2| base + field.as_ref().map_or(0.0, |field| field.value(place, *time));
            list.extend(places.iter().map(rate).map(|rate| rate.max(0.0)));
            list.as_slice()
        });
        (rates, bound)
    }

    /// Refuses rates of binding and unbinding that the fields make negative.
    pub(crate) fn check_rates(&self, base: [f64; 2]) -> Result<(), InterfaceError> {
        let lists = [("binding", &self.fields.binding, base[0]), ("unbinding", &self.fields.unbinding, base[1])];
        for (name, field, base) in lists {
            let Some(field) = field else { continue };
            for &place in &self.middles {
                let rate = base + field.value(place, self.time);
                if !(rate >= 0.0 && rate.is_finite()) {
                    return Err(InterfaceError::negative_rate(name, rate, place));
                }
            }
        }
        Ok(())
    }

    pub(crate) fn feels_exchange(&self) -> bool {
        self.fields.binding.is_some() || self.fields.unbinding.is_some()
    }
}

/// Replaces markers by the middles of the segments that follow them, which continue `advance` further along x (length).
/// With `smooth`, they lie on cubics through four neighbours, else on chords.
pub(crate) fn middles_of(places: &mut [Vec2], advance: f64, smooth: bool) {
    let count = places.len();
    let period = Vec2::new(advance, 0.0);
    let [Some(&first), Some(&last)] = [places.first(), places.last()] else { return };
    let second = if count > 1 { places[1] } else { first + period };
    let mut before = last - period;
    for k in 0..count {
        let here = places[k];
        let after = |steps: usize| match k + steps {
            next if next < count => places[next],
            next if next == count => first + period,
            _ => second + period,
        };
        let (next, beyond) = (after(1), after(2));
        places[k] = if smooth { (9.0 * (here + next) - (before + beyond)) / 16.0 } else { 0.5 * (here + next) };
        before = here;
    }
}
