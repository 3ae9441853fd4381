//! motile on a page: a layer over the crates of the library for JavaScript.
//!
//! [`live::Live`] is a scene that runs, [`knob::Knob`] a parameter that is turned on the way, [`dust::Dust`] the
//! tracers, [`concise::concise`] the text of a link, [`code::Way`] the same run elsewhere, [`branch::follow`] the map
//! of speeds. All of it is plain Rust, tested on the host; [`Engine`] hands it to JavaScript.

pub mod branch;
pub mod code;
pub mod concise;
pub mod dust;
pub mod frame;
pub mod knob;
pub mod live;
pub mod preset;
mod refusal;
pub mod text;

pub use refusal::Refusal;

use motile::active_interface::{Quantity, Units};
use motile::base::Vec2;
use motile::setup::Setup;
use serde_json::json;
use wasm_bindgen::prelude::*;

use code::Way;
use dust::Dust;
use knob::Knob;
use live::Live;

/// Number of tracers.
const TRACERS: usize = 700;

/// Error as JSON text, for JavaScript.
fn thrown(refusal: impl Into<Refusal>) -> JsValue {
    let refusal = refusal.into();
    let text = serde_json::to_string(&refusal).unwrap_or(refusal.message);
    JsValue::from_str(&text)
}

/// A scene that runs on the page. Errors are thrown as JSON text with message, key, value and remedy.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Engine {
    live: Live,
    dust: Dust,
    /// Time up to which tracers have drifted.
    drifted: f64,
}

#[wasm_bindgen]
impl Engine {
    /// Scene of the text of a scene file.
    ///
    /// # Errors
    /// Texts that are no scene.
    #[wasm_bindgen(constructor)]
    pub fn new(scene: &str) -> Result<Self, JsValue> {
        let setup = Setup::from_toml(scene).map_err(thrown)?;
        Ok(Self { live: Live::new(setup).map_err(thrown)?, dust: Dust::new(TRACERS), drifted: 0.0 })
    }

    /// Takes a step; false at the end (time), if there is one (not a number: none).
    ///
    /// # Errors
    /// Those of a run.
    pub fn step(&mut self, end: f64) -> Result<bool, JsValue> {
        self.live.step(Some(end).filter(|end| end.is_finite())).map_err(thrown)
    }

    /// Present time (time).
    #[must_use]
    pub fn time(&self) -> f64 {
        self.live.time()
    }

    /// Steps so far.
    #[must_use]
    pub fn steps(&self) -> u32 {
        u32::try_from(self.live.steps()).unwrap_or(u32::MAX)
    }

    /// Speed of a droplet (length per time); not a number where there is none.
    ///
    /// # Errors
    /// A flow that cannot be computed.
    pub fn speed(&mut self, droplet: usize) -> Result<f64, JsValue> {
        Ok(self.live.speed(droplet).map_err(thrown)?.unwrap_or(f64::NAN))
    }

    /// Data that do not change from step to step, as JSON: corner, periods and walls of the region, whether it is of
    /// revolution, mean concentrations, knobs with their labels, ranges and values, the error of the settings,
    /// whether there is a map of speeds, and Cowley's units: a length of 1 in um, a time of 1 in s, an activity of 1 in
    /// pN, a pressure of 1 in Pa.
    #[must_use]
    pub fn about(&self) -> String {
        let setup = self.live.described();
        let (domain, units) = (self.live.domain(), Units::thesis());
        let known = Knob::NAMES.iter().filter_map(|(name, knob)| {
            let ([least, most], logarithmic) = knob.range(setup);
            let (value, label) = (knob.value(setup)?, knob.label(setup));
            Some(json!({ "name": name, "label": label, "least": least.min(value), "most": most.max(value),
                         "step": if logarithmic { 0.0 } else { knob::STEP }, "value": value }))
        });
        let droplet = setup.droplets.first().or(setup.suspension.first().map(|entry| &entry.droplet));
        let concentration = droplet.and_then(|droplet| droplet.particles.as_ref()).map(|all| all.concentration);
        json!({
            "origin": domain.origin,
            "periods": domain.periods.lengths,
            "walls": domain.walls,
            "revolution": setup.region.is_axisymmetric(),
            "concentration": concentration,
            "activity": Knob::Activity.value(setup),
            "knobs": known.collect::<Vec<_>>(),
            "error": setup.expected_error(),
            "map": branch::mapped(setup).is_some(),
            "units": { "length": 1e6 * units.unit(Quantity::Length), "time": units.unit(Quantity::Time),
                       "activity": 1e12 * units.unit(Quantity::Activity),
                       "pressure": units.unit(Quantity::Stress) },
        })
        .to_string()
    }

    /// Displacement along x of images above (length), in a sheared box.
    #[must_use]
    pub fn tilt(&self) -> f64 {
        self.live.domain().periods.tilt
    }

    /// Shapes of the present state ([`frame::shapes`]).
    ///
    /// # Errors
    /// A flow that cannot be computed.
    pub fn shapes(&mut self) -> Result<Vec<f32>, JsValue> {
        Ok(frame::shapes(&self.live.outlined().map_err(thrown)?))
    }

    /// Derivative of the tension along the interface at the markers of all droplets ([`Live::tension_gradients`]).
    #[must_use]
    pub fn tension_gradients(&self) -> Vec<f32> {
        self.live.tension_gradients()
    }

    /// Flow of the present state, which tracers follow from now on: the corner, size and numbers of cells of its
    /// raster, then the pressure (force per length) of each cell, then if asked for the streamlines
    /// ([`frame::lines`]).
    ///
    /// # Errors
    /// A flow that cannot be computed.
    pub fn flow(&mut self, streamlines: bool) -> Result<Vec<f32>, JsValue> {
        let seen = self.live.seen().map_err(thrown)?;
        self.dust.see(&seen).map_err(thrown)?;
        let ([x, y], [width, height], [nx, ny]) = (seen.raster.origin(), seen.raster.size(), seen.raster.cells());
        let mut list: Vec<f32> = [x, y, width, height, nx as f64, ny as f64].map(|value| value as f32).to_vec();
        list.extend(seen.flow.iter().map(|sample| sample.pressure as f32));
        if streamlines {
            list.extend(frame::lines(&seen, [width, height]).map_err(thrown)?);
        }
        Ok(list)
    }

    /// Lets tracers drift up to the present time in the last flow that was seen, within a rectangle (length), and gives
    /// their places and velocities ([`Dust::streaks`]).
    #[must_use]
    pub fn drift(&mut self, left: f64, bottom: f64, right: f64, top: f64) -> Vec<f32> {
        let dt = (self.live.time() - self.drifted).clamp(0.0, 1.0);
        self.drifted = self.live.time();
        self.dust.drift(dt, [Vec2::new(left, bottom), Vec2::new(right, top)]);
        self.dust.streaks()
    }

    /// Number of records of the table.
    #[must_use]
    pub fn records(&self) -> usize {
        self.live.records()
    }

    /// Series that are plotted of the records from one on ([`Live::series`]).
    #[must_use]
    pub fn series(&self, from: usize) -> Vec<f64> {
        self.live.series(from)
    }

    /// Table of all records as CSV.
    #[must_use]
    pub fn csv(&self) -> String {
        self.live.csv()
    }

    /// Picture of the present state as SVG.
    ///
    /// # Errors
    /// A flow that cannot be computed.
    pub fn svg(&mut self) -> Result<String, JsValue> {
        self.live.svg().map_err(thrown)
    }

    /// Text of the scene file, without what is as by default.
    ///
    /// # Errors
    /// A description that has no text.
    pub fn scene(&self) -> Result<String, JsValue> {
        concise::concise(self.live.described()).map_err(thrown)
    }

    /// Text that runs the scene up to a time (time) elsewhere: `command`, `python` or `rust`.
    ///
    /// # Errors
    /// Another way.
    pub fn code(&self, way: &str, until: f64) -> Result<String, JsValue> {
        Way::named(way).and_then(|way| way.text(self.live.described(), until)).map_err(thrown)
    }

    /// Doubts about the states since the last change of a parameter, as a JSON list.
    #[must_use]
    pub fn warnings(&self) -> String {
        let told = |live::Doubt { warning, until, present }: &live::Doubt| {
            json!({ "body": warning.body, "cause": warning.cause, "message": warning.message, "until": until,
                    "present": present })
        };
        self.live.doubts().iter().map(told).collect::<serde_json::Value>().to_string()
    }

    /// Goes on with another value of a parameter.
    ///
    /// # Errors
    /// Values for which there is no scene.
    pub fn turn(&mut self, knob: &str, value: f64) -> Result<(), JsValue> {
        Knob::named(knob).and_then(|knob| self.live.turn(knob, value)).map_err(thrown)
    }

    /// Number of the droplet at a point (length), -1 where there is none.
    #[must_use]
    pub fn droplet_at(&self, x: f64, y: f64) -> i32 {
        self.live.droplet_at(Vec2::new(x, y)).and_then(|number| i32::try_from(number).ok()).unwrap_or(-1)
    }

    /// Moves a droplet by a displacement (length).
    ///
    /// # Errors
    /// A place where there is no room.
    pub fn drag(&mut self, droplet: usize, x: f64, y: f64) -> Result<(), JsValue> {
        self.live.drag(droplet, Vec2::new(x, y)).map_err(thrown)
    }
}

/// Text of a scene file with another value of a parameter ([`text::turned`]).
///
/// # Errors
/// Texts that are no scene, and values for which there is none.
#[wasm_bindgen]
pub fn turned(text: &str, knob: &str, value: f64) -> Result<String, JsValue> {
    Knob::named(knob).and_then(|knob| text::turned(text, knob, value)).map_err(thrown)
}

/// Presets as JSON.
#[wasm_bindgen]
#[must_use]
pub fn presets() -> String {
    serde_json::to_string(&preset::PRESETS).unwrap_or_default()
}

/// Follows the branch of steady states of a scene over the activity: `seen(activity, speed, stable, line)` is called
/// with each point, the number of its line in the order of [`branch::Line`], until it returns false.
///
/// # Errors
/// Scenes without a branch.
#[wasm_bindgen]
pub fn branch_of(scene: &str, seen: &js_sys::Function) -> Result<(), JsValue> {
    let setup = Setup::from_toml(scene).map_err(thrown)?;
    let tell = |point: branch::MapPoint| {
        let line = point.line as u32;
        let values: [JsValue; 4] = [point.activity.into(), point.speed.into(), point.stable.into(), line.into()];
        let list = values.into_iter().collect::<js_sys::Array>();
        seen.apply(&JsValue::NULL, &list).is_ok_and(|more| more.as_bool() != Some(false))
    };
    branch::follow(&setup, tell).map_err(thrown)
}
