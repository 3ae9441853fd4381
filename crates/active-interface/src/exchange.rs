//! Exchange of particles between an interface and the inside of its droplet.

use motile_base::{not_negative, positive};

use crate::InterfaceError;

/// Rates of binding to the interface of a droplet and unbinding into its inside, `dc/dt = ... + k_on C - k_off c`, c
/// the concentration on the interface (particles per length), C the concentration inside, next to the interface
/// (particles per area). Whitfield and Hawkins, "Immersed boundary simulations of active fluid droplets", PLoS ONE 11
/// (2016) e0162474, have such a model.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("binding", "unbinding", "adsorption", "desorption", "soluble surfactant"))]
pub struct Exchange {
    binding: f64,
    unbinding: f64,
}

impl Exchange {
    /// Creates the rates k_on of binding (length per time) and k_off of unbinding (1/time).
    ///
    /// # Errors
    /// Returns an error for rates that are negative or not finite.
    pub fn new(binding: f64, unbinding: f64) -> Result<Self, InterfaceError> {
        not_negative("the rate of binding", binding)?;
        not_negative("the rate of unbinding", unbinding)?;
        Ok(Self { binding, unbinding })
    }

    /// Returns the rate k_on of binding (length per time).
    #[must_use]
    pub fn binding(&self) -> f64 {
        self.binding
    }

    /// Returns the rate k_off of unbinding (1/time).
    #[must_use]
    pub fn unbinding(&self) -> f64 {
        self.unbinding
    }

    /// Returns the concentration inside (particles per area) in equilibrium with the concentration c = `on` of the
    /// interface (particles per length), `C = k_off c/k_on`; `None` if nothing binds, so that all particles leave the
    /// interface.
    #[must_use]
    pub fn concentration_at_rest(&self, on: f64) -> Option<f64> {
        match (self.binding > 0.0, self.unbinding > 0.0) {
            (true, _) => Some(self.unbinding * on / self.binding),
            (false, false) => Some(0.0),
            (false, true) => None,
        }
    }
}

/// Particles inside a droplet, well mixed: of one concentration everywhere, as with fast diffusion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pool {
    pub(crate) exchange: Exchange,
    pub(crate) number: f64,
    /// Area of the droplet at the start (length squared), which it keeps.
    area: f64,
}

impl Pool {
    pub(crate) fn new(exchange: Exchange, number: f64, area: f64) -> Result<Self, InterfaceError> {
        not_negative("the number of particles inside", number)?;
        Ok(Self { exchange, number, area: positive("the area of a droplet", area)? })
    }

    /// Returns the rate at which a particle inside goes to an interface of this length (1/time).
    fn rate(&self, perimeter: f64) -> f64 {
        self.exchange.binding * perimeter / self.area
    }

    /// Returns the particles that bind less those that unbind (1/time).
    pub(crate) fn flux(&self, lengths: &[f64], on: f64) -> f64 {
        self.rate(lengths.iter().sum()) * self.number - self.exchange.unbinding * on
    }

    /// Adds `factor` (time) times the rates of exchange to the numbers of the segments; returns the change of the
    /// number inside.
    pub(crate) fn add(&self, factor: f64, lengths: &[f64], numbers: &[f64], inside: f64, out: &mut [f64]) -> f64 {
        let unit = factor * self.exchange.binding * inside / self.area;
        let mut loss = 0.0;
        for ((out, length), number) in out.iter_mut().zip(lengths).zip(numbers) {
            let change = unit * length - factor * self.exchange.unbinding * number;
            *out += change;
            loss -= change;
        }
        loss
    }

    /// Returns the area inside (length squared).
    pub(crate) fn area(&self) -> f64 {
        self.area
    }

    /// Adds the rates of exchange as [`Pool::add`] does, with rates of binding and unbinding on each segment.
    pub(crate) fn add_at(
        &self,
        [binding, unbinding]: [&[f64]; 2],
        factor: f64,
        lengths: &[f64],
        numbers: &[f64],
        inside: f64,
        out: &mut [f64],
    ) -> f64 {
        let density = inside / self.area;
        let mut loss = 0.0;
        for (k, out) in out.iter_mut().enumerate() {
            let change = factor * (binding[k] * density * lengths[k] - unbinding[k] * numbers[k]);
            *out += change;
            loss -= change;
        }
        loss
    }

    /// Solves a step as [`Pool::solve`] does, with rates of binding and unbinding on each segment; `diffuse(losses,
    /// numbers)` solves one of diffusion and of losses at the rates `losses` (1/time). With the numbers P inside, the
    /// numbers on the segments are `a + b P`, where a and b are the solutions for the numbers and for what binds.
    pub(crate) fn solve_at(
        &self,
        ([binding, unbinding], bound): ([&[f64]; 2], &mut Vec<f64>),
        factor: f64,
        lengths: &[f64],
        numbers: &mut [f64],
        inside: &mut f64,
        mut diffuse: impl FnMut(&[f64], &mut [f64]),
    ) {
        let total = *inside + numbers.iter().sum::<f64>();
        diffuse(unbinding, numbers);
        bound.clear();
        bound.extend(binding.iter().zip(lengths).map(|(k, l)| factor * k * l / self.area));
        let binds: f64 = bound.iter().sum();
        diffuse(unbinding, bound);
        let unbinds = |numbers: &[f64]| factor * numbers.iter().zip(unbinding).map(|(n, k)| n * k).sum::<f64>();
        let number = (*inside + unbinds(numbers)) / (1.0 + binds - unbinds(bound));
        numbers.iter_mut().zip(&*bound).for_each(|(on, bound)| *on += bound * number);
        // The sum of all is kept to round-off.
        *inside = total - numbers.iter().sum::<f64>();
    }

    /// Solves a step of exchange and diffusion, both implicit over the time `factor` f, for the numbers on the segments
    /// and inside; `diffuse(f, numbers)` solves one of diffusion alone. The sum of all numbers is kept.
    ///
    /// With the numbers n on the segments and P inside, `n - f (diffusion + k_on l P/A - k_off n) = r` has the solution
    /// `n = a + b P`, where b is `f k_on l/(A (1 + f k_off))`. Numbers in proportion to the lengths l do not diffuse,
    /// and a solves the diffusion of `r/(1 + f k_off)` over the time `f/(1 + f k_off)`.
    pub(crate) fn solve(
        &self,
        factor: f64,
        lengths: &[f64],
        numbers: &mut [f64],
        inside: &mut f64,
        diffuse: impl FnOnce(f64, &mut [f64]),
    ) {
        let Exchange { binding, unbinding } = self.exchange;
        let part = 1.0 / (1.0 + factor * unbinding);
        numbers.iter_mut().for_each(|number| *number *= part);
        diffuse(factor / (1.0 + factor * unbinding), numbers);
        let left: f64 = numbers.iter().sum();
        let perimeter: f64 = lengths.iter().sum();
        let number = (*inside + factor * unbinding * left) / (1.0 + factor * self.rate(perimeter) * part);
        let bound = factor * binding * number * part / self.area;
        numbers.iter_mut().zip(lengths).for_each(|(on, length)| *on += bound * length);
        *inside = number;
    }
}

#[cfg(test)]
mod tests;
