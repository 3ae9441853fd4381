//! How the pictures of a run look, as flags of a command line.

use clap::Args;
use motile_output::Look;

use crate::command_line::positive;

/// Settings of pictures and animations. What is not given stays as the run has it.
#[derive(Debug, Clone, Default, PartialEq, Args)]
#[command(next_help_heading = "Pictures")]
pub struct LookFlags {
    /// Lowest and highest pressure that colours show (force per length); without it nearly all that there are
    #[arg(long, value_name = "LOW,HIGH", value_parser = range, allow_hyphen_values = true)]
    pub pressure_range: Option<[f64; 2]>,
    /// Unit of length in the labels of pictures, as text; positions are not converted
    #[arg(long, value_name = "TEXT")]
    pub length_unit: Option<String>,
    /// Spacing of the fields in pictures and files (length) [default: the grid's, or a twentieth of a radius]
    #[arg(long, value_name = "LENGTH", value_parser = positive)]
    pub picture_spacing: Option<f64>,
    /// Width of the picture (cm), from 1 to 100 [default: 16]
    #[arg(long, value_name = "CM")]
    pub picture_width: Option<f64>,
    /// Size of the type (pt), from 1 to 72 [default: 8]
    #[arg(long, value_name = "PT")]
    pub font_size: Option<f64>,
    /// Pixels per cm of the picture, from 10 to 1000 [default: 75]
    #[arg(long, value_name = "PIXELS")]
    pub resolution: Option<f64>,
}

impl LookFlags {
    /// Returns the settings of a run, replaced by the flags that were given.
    #[must_use]
    pub fn apply(&self, look: Look) -> Look {
        Look {
            pressure_range: self.pressure_range.or(look.pressure_range),
            length_unit: self.length_unit.clone().unwrap_or(look.length_unit),
            width: self.picture_width.unwrap_or(look.width),
            font_size: self.font_size.unwrap_or(look.font_size),
            resolution: self.resolution.unwrap_or(look.resolution),
            ..look
        }
    }
}

fn range(text: &str) -> Result<[f64; 2], String> {
    let ends = text.split_once(',').map(|(low, high)| [low, high].map(|end| end.trim().parse::<f64>().ok()));
    match ends {
        Some([Some(low), Some(high)]) if low < high && (high - low).is_finite() => Ok([low, high]),
        _ => Err("must be two numbers with a comma between them, the lower one first".to_owned()),
    }
}
