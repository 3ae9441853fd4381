//! Results that a scene collects over all its steps.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::{Warning, hydrodynamics::FlowWork, saved_state::Record};

/// Work, smallest gaps, records of observers and warnings since the start; checkpoints hold them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Findings {
    /// Work of all evaluations.
    pub(crate) work: FlowWork,
    /// Smallest gap between interfaces and rigid walls or obstacles (length).
    pub(crate) wall_gap: Option<f64>,
    /// Smallest gap between an interface and another body or its own image (length).
    pub(crate) gap: Option<f64>,
    /// Records of observers by their names.
    pub(crate) records: BTreeMap<String, Record>,
    /// Worst warning of each body and cause, with its time.
    pub(crate) warnings: Vec<(f64, Warning)>,
}

/// Lowers a minimum to `value`, if there is one.
pub(super) fn lower(minimum: &mut Option<f64>, value: Option<f64>) {
    *minimum = [*minimum, value].into_iter().flatten().reduce(f64::min);
}
