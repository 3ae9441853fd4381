//! Ticks of an axis: positions and labels.

/// Tick of an axis, long with a label and short without.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tick {
    pub(crate) value: f64,
    pub(crate) label: Option<String>,
}

/// Ticks of an axis.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Ticks {
    pub(crate) ticks: Vec<Tick>,
    /// Exponent of the power of ten by which labels are to be multiplied, mostly 0.
    pub(crate) exponent: i32,
}

impl Ticks {
    /// Ticks of a linear axis, about `target` within `low..=high`, at multiples of 1, 2 or 5 times a power of ten.
    pub(crate) fn linear(low: f64, high: f64, target: usize) -> Self {
        let span = high - low;
        // Ends that differ by little more than round-off cannot be told apart by labels.
        if !(span.is_finite() && span > 1e-9 * low.abs().max(high.abs())) {
            let ticks = if low.is_finite() { vec![Tick { value: low, label: Some(number(low)) }] } else { vec![] };
            return Self { ticks, exponent: 0 };
        }
        let multiples = |step: f64| {
            let slack = 1e-9 * step;
            ((low - slack) / step).ceil() as i64..=((high + slack) / step).floor() as i64
        };
        // A short axis may fall between the multiples of a step: two ticks are the least that show a scale.
        let mut step = nice_step(span / target.max(1) as f64);
        while multiples(step).count() < 2 {
            step = nice_step_below(0.99 * step);
        }
        let largest = low.abs().max(high.abs());
        let magnitude = largest.log10().floor() as i32;
        let exponent = if (-2..5).contains(&magnitude) { 0 } else { magnitude };
        let unit = 10f64.powi(exponent);
        let decimals = (-(step / unit * 1.000_001).log10().floor()).clamp(0.0, 12.0) as usize;
        let tick = |k: i64| {
            let value = k as f64 * step;
            Tick { value, label: Some(signed(&format!("{:.decimals$}", value / unit))) }
        };
        Self { ticks: multiples(step).map(tick).collect(), exponent }
    }

    /// Ticks of a logarithmic axis: decades with labels and the multiples between without; where the axis is shorter
    /// than two decades, multiples get labels too. Both ends must be positive.
    pub(crate) fn logarithmic(low: f64, high: f64) -> Self {
        let positive = low > 0.0 && high.is_finite() && high > low;
        if !positive {
            return Self::default();
        }
        let (first, last) = (low.log10().floor() as i32, high.log10().ceil() as i32);
        let decades = (high / low).log10();
        let every = (decades / 7.0).ceil().max(1.0) as i32;
        let labelled: &[u32] = match decades {
            d if d < 0.7 => &[1, 2, 3, 4, 5, 6, 7, 8, 9],
            d if d < 2.0 => &[1, 2, 5],
            _ => &[1],
        };
        let plain = first >= -2 && last <= 3;
        let decade_label = |k: i32| if plain { number(10f64.powi(k)) } else { signed(&format!("10^{{{k}}}")) };
        let mut ticks = Vec::new();
        for decade in first..=last {
            for multiple in 1..10 {
                let value = f64::from(multiple) * 10f64.powi(decade);
                if value < low * (1.0 - 1e-9) || value > high * (1.0 + 1e-9) || (multiple > 1 && every > 1) {
                    continue;
                }
                let named = labelled.contains(&multiple) && decade % every == 0;
                let label = named.then(|| if labelled.len() > 1 { number(value) } else { decade_label(decade) });
                ticks.push(Tick { value, label });
            }
        }
        Self { ticks, exponent: 0 }
    }
}

/// Returns the smallest of 1, 2, 5 times a power of ten that is not below `raw`, or by round-off only.
fn nice_step(raw: f64) -> f64 {
    let decade = 10f64.powf(raw.log10().floor());
    let multiple = [1.0, 2.0, 5.0].into_iter().find(|m| m * decade >= raw * (1.0 - 1e-9)).unwrap_or(10.0);
    multiple * decade
}

/// Returns the largest of 1, 2, 5 times a power of ten that is not above `raw`.
pub(crate) fn nice_step_below(raw: f64) -> f64 {
    let decade = 10f64.powf(raw.log10().floor());
    let multiple = [5.0, 2.0].into_iter().find(|m| m * decade <= raw * (1.0 + 1e-9)).unwrap_or(1.0);
    multiple * decade
}

/// Returns the number as text, to four significant figures without trailing zeros.
pub(crate) fn number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".into() } else { signed(&value.to_string()) };
    }
    let magnitude = value.abs().log10().floor() as i32;
    if !(-3..6).contains(&magnitude) {
        let mantissa = number(value / 10f64.powi(magnitude));
        let factor = signed(&format!("10^{{{magnitude}}}"));
        return if mantissa == "1" { factor } else { format!("{mantissa}×{factor}") };
    }
    let text = format!("{value:.*}", (3 - magnitude).max(0) as usize);
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    signed(text)
}

/// Returns the number as text with a minus sign for the hyphen, and zero without a sign.
fn signed(text: &str) -> String {
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| c == '0' || c == '.') => rest.to_string(),
        _ => text.replace('-', "−"),
    }
}

#[cfg(test)]
mod tests;
