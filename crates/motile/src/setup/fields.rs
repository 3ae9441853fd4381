//! Descriptions of fields that interfaces feel, and of noise on their particles.

use active_interface::{
    Field, Fields, InterfaceError, Noise,
    field::{Modulation, Table},
};
use motile_base::Vec2;
use serde::{Deserialize, Serialize};

use super::{Particles, Setup, checked::Checked};
use crate::SetupError;

/// Fields that a droplet or an interface feels, fixed in the laboratory. Each is the sum of its entries.
///
/// Positions are unwrapped: a droplet that leaves a box on one side continues along a gradient. Waves have to fit the
/// region's periods, and spots and tables repeat with them.
///
/// ```
/// use motile::prelude::*;
///
/// // A drop in a gradient of tension G swims towards lower tension, at G R/(4 (eta_in + eta_ext)).
/// let gradient = GradientSetup { slope: [1.0, 0.0], origin: [0.0, 0.0] };
/// let tension = vec![FieldEntry { gradient: Some(gradient), ..FieldEntry::default() }];
/// let setup = Setup {
///     region: Region::Plane,
///     droplets: vec![DropletSetup {
///         fields: FieldsSetup { tension, ..FieldsSetup::default() },
///         ..DropletSetup::passive(10.0)
///     }],
///     ..Setup::default()
/// };
/// let Built { mut scene, droplets, .. } = setup.build()?;
/// let seen = scene.observe(droplets[0])?;
/// println!("velocity {:.6e}", seen.velocity.x);
/// assert!((seen.velocity.x + 1.0 / 800.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct FieldsSetup {
    /// Field that is added to the tension (force; in three dimensions force per length).
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tension: Vec<FieldEntry>,
    /// Field that is added to the activity (force times length; in three dimensions force times length squared).
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub activity: Vec<FieldEntry>,
    /// Field that is added to the rate of binding (length per time) of an exchange with a well-mixed inside.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub binding: Vec<FieldEntry>,
    /// Field that is added to the rate of unbinding (1/time) of an exchange with a well-mixed inside.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub unbinding: Vec<FieldEntry>,
    /// Field that is added to the friction with a substrate (force times time per length squared).
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub friction: Vec<FieldEntry>,
}

/// An entry of a field: one of the kinds, and a factor that depends on time.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct FieldEntry {
    /// One value for all places (unit of the field).
    pub uniform: Option<f64>,
    /// A constant slope.
    pub gradient: Option<GradientSetup>,
    /// A Gaussian spot.
    pub spot: Option<SpotSetup>,
    /// A wave.
    pub wave: Option<WaveSetup>,
    /// Values on a grid.
    pub table: Option<TableSetup>,
    /// Factor that depends on time.
    pub modulation: Option<ModulationSetup>,
}

/// A constant slope: `slope . (x - origin)`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct GradientSetup {
    /// Slope (unit of the field per length).
    pub slope: [f64; 2],
    /// Place where it is zero (length).
    #[serde(default)]
    pub origin: [f64; 2],
}

/// A Gaussian spot: `amplitude exp(-|x - centre|^2/(2 radius^2))`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct SpotSetup {
    /// Centre (length).
    #[serde(default)]
    pub centre: [f64; 2],
    /// Standard deviation (length).
    pub radius: f64,
    /// Value at the centre (unit of the field).
    pub amplitude: f64,
}

/// A wave: `amplitude sin(k . x - frequency t + phase)`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct WaveSetup {
    /// Amplitude (unit of the field).
    pub amplitude: f64,
    /// Wave vector k (radians per length).
    pub wave_vector: [f64; 2],
    /// Angular frequency (radians per time).
    #[serde(default)]
    pub frequency: f64,
    /// Phase (radians).
    #[serde(default)]
    pub phase: f64,
}

/// Values on a regular grid, see [`Table`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct TableSetup {
    /// Place of the first value (length).
    pub origin: [f64; 2],
    /// Distances of the values along x and y (length).
    pub spacing: [f64; 2],
    /// Rows of values along x, from the lowest y on (unit of the field).
    pub values: Vec<Vec<f64>>,
}

/// A factor `mean + amplitude cos(frequency t + phase)`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct ModulationSetup {
    /// Angular frequency (radians per time).
    pub frequency: f64,
    /// Mean (no dimension).
    #[serde(default)]
    pub mean: f64,
    /// Amplitude (no dimension).
    #[serde(default = "one")]
    pub amplitude: f64,
    /// Phase at time 0 (radians).
    #[serde(default)]
    pub phase: f64,
}

/// Noise on particles, see [`Noise`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct NoiseSetup {
    /// Seed; equal seeds give equal runs. Each body of a scene has different noise.
    #[serde(default = "first")]
    pub seed: u64,
    /// Factor of the amplitude (no dimension): 1 if each particle counts once.
    #[serde(default = "one")]
    pub strength: f64,
}

impl Default for NoiseSetup {
    /// Creates the noise of particles that count once, of the seed 1.
    fn default() -> Self {
        Self { seed: 1, strength: 1.0 }
    }
}

fn one() -> f64 {
    1.0
}

fn first() -> u64 {
    1
}

fn vector([x, y]: [f64; 2]) -> Vec2 {
    Vec2::new(x, y)
}

impl FieldEntry {
    /// Returns the names of the kinds that it gives.
    fn kinds(&self) -> Vec<&'static str> {
        let given = [
            ("uniform", self.uniform.is_some()),
            ("gradient", self.gradient.is_some()),
            ("spot", self.spot.is_some()),
            ("wave", self.wave.is_some()),
            ("table", self.table.is_some()),
        ];
        given.into_iter().filter_map(|(name, given)| given.then_some(name)).collect()
    }

    fn field(&self) -> Result<Field, InterfaceError> {
        let parts = [
            self.uniform.map(Field::uniform),
            self.gradient.map(|gradient| Field::gradient(vector(gradient.slope), vector(gradient.origin))),
            self.spot.map(|spot| Field::spot(vector(spot.centre), spot.radius, spot.amplitude)),
            self.wave.map(|WaveSetup { amplitude, wave_vector, frequency, phase }| {
                Field::wave(amplitude, vector(wave_vector), frequency, phase)
            }),
            self.table.as_ref().map(|TableSetup { origin, spacing, values }| {
                Ok(Field::table(Table::new(vector(*origin), vector(*spacing), values)?))
            }),
        ];
        let mut sum = Field::default();
        for part in parts.into_iter().flatten() {
            sum += part?;
        }
        match self.modulation {
            Some(ModulationSetup { frequency, mean, amplitude, phase }) => {
                sum.modulated(Modulation { mean, amplitude, frequency, phase })
            }
            None => Ok(sum),
        }
    }

    /// Refuses numbers out of their range under this key, other than one kind, and what does not fit the region.
    fn check(&self, checked: &Checked<'_>, key: &str, setup: &Setup) -> Result<(), SetupError> {
        let kinds = self.kinds();
        let text = if kinds.is_empty() { "empty".to_owned() } else { kinds.join(", ") };
        let remedy = "give one of uniform, gradient, spot, wave and table. A list of entries adds up";
        checked.refuse_if(kinds.len() != 1, key, text, remedy)?;
        let name = |name: &str| format!("{key}.{name}");
        checked.finite(&name("uniform"), self.uniform)?;
        if let Some(GradientSetup { slope, origin }) = &self.gradient {
            checked.all_finite(&name("gradient.slope"), slope)?;
            checked.all_finite(&name("gradient.origin"), origin)?;
        }
        if let Some(SpotSetup { centre, radius, amplitude }) = &self.spot {
            checked.all_finite(&name("spot.centre"), centre)?;
            checked.positive(&name("spot.radius"), *radius)?;
            checked.finite(&name("spot.amplitude"), *amplitude)?;
        }
        if let Some(WaveSetup { amplitude, wave_vector, frequency, phase }) = &self.wave {
            checked.finite(&name("wave.amplitude"), *amplitude)?;
            checked.all_finite(&name("wave.wave-vector"), wave_vector)?;
            checked.finite(&name("wave.frequency"), *frequency)?;
            checked.finite(&name("wave.phase"), *phase)?;
        }
        if let Some(TableSetup { origin, spacing, values }) = &self.table {
            checked.all_finite(&name("table.origin"), origin)?;
            for &spacing in spacing {
                checked.positive(&name("table.spacing"), spacing)?;
            }
            for (k, row) in values.iter().enumerate() {
                checked.all_finite(&name(&format!("table.values[{k}]")), row)?;
            }
        }
        if let Some(ModulationSetup { frequency, mean, amplitude, phase }) = self.modulation {
            for (part, value) in [("frequency", frequency), ("mean", mean), ("amplitude", amplitude), ("phase", phase)]
            {
                checked.finite(&name(&format!("modulation.{part}")), value)?;
            }
        }
        let made = self.field().and_then(|field| field.periodic(setup.region.periods()));
        let refused = |error: InterfaceError| checked.refuse::<Field>(&name(kinds[0]), &"given", error.to_string());
        let field = made.or_else(refused)?;
        let remedy = "it is not symmetric about the axis of a three-dimensional region. Use slopes and wave vectors \
                      along x, centres on the axis, and tables that are symmetric about it";
        let odd = setup.region.is_axisymmetric() && !field.is_symmetric(1.0);
        checked.refuse_if(odd, &name(kinds[0]), "given", remedy)
    }
}

impl FieldsSetup {
    fn named(&self) -> [(&'static str, &Vec<FieldEntry>); 5] {
        let Self { tension, activity, binding, unbinding, friction } = self;
        [
            ("tension", tension),
            ("activity", activity),
            ("binding", binding),
            ("unbinding", unbinding),
            ("friction", friction),
        ]
    }

    /// Returns true if there are no fields.
    #[must_use]
    pub fn is_none(&self) -> bool {
        self.named().iter().all(|(_, entries)| entries.is_empty())
    }

    /// Returns the fields in a region with these periods (length).
    ///
    /// # Errors
    /// Returns an error for numbers out of their range, and for what does not fit the periods.
    pub fn fields(&self, periods: [Option<f64>; 2]) -> Result<Fields, InterfaceError> {
        let sum = |entries: &[FieldEntry]| -> Result<Option<Field>, InterfaceError> {
            let mut sum = Field::default();
            for entry in entries {
                sum += entry.field()?;
            }
            (!entries.is_empty()).then(|| sum.periodic(periods)).transpose()
        };
        Ok(Fields {
            tension: sum(&self.tension)?,
            activity: sum(&self.activity)?,
            binding: sum(&self.binding)?,
            unbinding: sum(&self.unbinding)?,
            friction: sum(&self.friction)?,
        })
    }

    /// Refuses fields of what the body does not have, and entries that cannot be.
    pub(super) fn check(
        &self,
        checked: &Checked<'_>,
        particles: Option<&Particles>,
        setup: &Setup,
    ) -> Result<(), SetupError> {
        let remedy = "without particles there is no activity. Use fields.tension, or give it particles";
        checked.refuse_if(particles.is_none() && !self.activity.is_empty(), "fields.activity", "given", remedy)?;
        let graded = setup.region.is_axisymmetric() && !self.friction.is_empty();
        let remedy = "friction with a substrate exists in two dimensions only. Remove the key";
        checked.refuse_if(graded, "fields.friction", "given", remedy)?;
        let exchange = particles.and_then(|particles| particles.exchange);
        let mixed = exchange.is_some_and(|exchange| exchange.diffusion_inside.is_none());
        for (name, entries) in self.named() {
            let key = format!("fields.{name}");
            let remedy = "it needs particles.exchange without diffusion-inside, that is a well-mixed inside. Remove \
                          one of them";
            checked.refuse_if(name.ends_with("binding") && !mixed && !entries.is_empty(), &key, "given", remedy)?;
            for (number, entry) in entries.iter().enumerate() {
                entry.check(checked, &format!("{key}[{number}]"), setup)?;
            }
        }
        Ok(())
    }
}

impl NoiseSetup {
    /// Returns the noise.
    ///
    /// # Errors
    /// Returns an error for a strength that is negative or not finite.
    pub fn noise(&self) -> Result<Noise, InterfaceError> {
        Noise::new(self.seed).with_strength(self.strength)
    }

    /// Refuses a strength out of its range, and noise on particles that do not diffuse or that diffuse inside.
    pub(super) fn check(&self, checked: &Checked<'_>, particles: &Particles) -> Result<(), SetupError> {
        checked.not_negative("particles.noise.strength", self.strength)?;
        let remedy = "the noise comes from their diffusion, which is zero. Use a positive particles.diffusion";
        checked.refuse_if(particles.diffusion == 0.0, "particles.noise", "given", remedy)?;
        let inside = particles.exchange.is_some_and(|exchange| exchange.diffusion_inside.is_some());
        let remedy =
            "particles that diffuse inside have no noise yet. Use a well-mixed inside, without diffusion-inside";
        checked.refuse_if(inside, "particles.noise", "given", remedy)
    }
}

#[cfg(test)]
mod tests;
