//! Densities of layers: which forces of single layers are given later, and the velocities of a double layer.

/// Curves whose single layer is stored as a matrix, because their forces are given after the positions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct StoredLayers {
    /// The first of these curves; all behind it are stored too.
    pub(crate) first: usize,
    /// True where layers between two stored curves are computed, false if only those between a stored curve and another
    /// one are.
    pub(crate) mutual: bool,
}

impl StoredLayers {
    /// Returns true for a curve whose layer is stored.
    pub(crate) fn has(self, curve: usize) -> bool {
        curve >= self.first
    }

    /// Returns true for two curves between which a layer is computed.
    pub(crate) fn couples(self, target: usize, source: usize) -> bool {
        self.mutual || target < self.first || source < self.first
    }
}

/// Density of a double layer: velocities at the nodes (length per time), x then y, curve after curve, and the factor of
/// each curve, its viscosity inside less that outside. Curves beyond these have no double layer.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Density<'a> {
    pub(crate) values: &'a [f64],
    pub(crate) contrasts: &'a [f64],
}

impl<'a> Density<'a> {
    /// No double layer at all.
    pub(crate) const NONE: Self = Self { values: &[], contrasts: &[] };

    /// Returns the nodes of each curve.
    pub(crate) fn nodes(&self) -> usize {
        self.values.len() / (2 * self.contrasts.len()).max(1)
    }

    /// Returns the components x and y at the nodes of one curve.
    pub(crate) fn of(&self, curve: usize) -> (&'a [f64], &'a [f64]) {
        self.values_of(curve).split_at(self.nodes())
    }

    /// Returns the components at the nodes of one curve, x then y.
    pub(crate) fn values_of(&self, curve: usize) -> &'a [f64] {
        let len = 2 * self.nodes();
        &self.values[len * curve..len * (curve + 1)]
    }

    /// Returns the factor of the velocities of a curve; zero without a double layer.
    pub(crate) fn contrast(&self, curve: usize) -> f64 {
        self.contrasts.get(curve).copied().unwrap_or(0.0)
    }

    /// Returns true if no curve has a double layer.
    pub(crate) fn vanishes(&self) -> bool {
        self.contrasts.iter().all(|contrast| *contrast == 0.0)
    }
}
