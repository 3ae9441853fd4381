//! Scene files: descriptions in TOML.

use super::Setup;
use crate::SetupError;

impl Setup {
    /// The description in a TOML text. What is left out is as in [`Setup::default`] and
    /// [`crate::DropletSetup::default`], but droplets that are not named are not there. A droplet is active unless it
    /// says `particles = "none"`.
    ///
    /// ```
    /// use motile::Setup;
    ///
    /// let text = "viscosity = 50.0\n[[droplets]]\ncentre = [0.5, 0.0]\nparticles.activity = -3.0\n";
    /// let setup = Setup::from_toml(text)?;
    /// assert_eq!((setup.viscosity, setup.droplets[0].activity()), (50.0, -3.0));
    /// let refused = Setup::from_toml("viscosty = 50.0").unwrap_err().to_string();
    /// assert!(refused.contains("unknown field `viscosty`"), "{refused}");
    /// # Ok::<(), motile::SetupError>(())
    /// ```
    ///
    /// # Errors
    /// A text that is no TOML, keys that do not exist, values of the wrong type ([`SetupError::File`], with the line),
    /// and what [`Setup::check`] refuses.
    pub fn from_toml(text: &str) -> Result<Self, SetupError> {
        let setup: Self = toml::from_str(text).map_err(|error| SetupError::File { problem: error.to_string() })?;
        setup.check()?;
        Ok(setup)
    }

    /// The description as a TOML text, all entries written out, from which [`Setup::from_toml`] makes it again.
    ///
    /// # Errors
    /// [`SetupError::File`]: a seed above 9223372036854775807, which TOML has no number for.
    pub fn to_toml(&self) -> Result<String, SetupError> {
        // By way of a table: the serializer of documents would be compiled for every part of the description.
        let table = toml::Table::try_from(self).map_err(|error| SetupError::File { problem: error.to_string() })?;
        Ok(table.to_string())
    }
}
