//! A scene that runs on the page, step by step.

use motile::active_interface::ActiveDroplet;
use motile::base::{Region, Vec2, boxes::nearest_image, internal::decimals, polygon};
use motile::scene::{Body, Handle, SceneError, Warning};
use motile::setup::{Built, Setup};
use motile_output::{CsvTable, DropletMeter, Look, Raster, Snapshot};

use crate::{Refusal, knob::Knob};

/// Time between two rows of the table (time scales of the scene).
const ROW: f64 = 0.1;
/// Most numbers in the table: from there on every second row goes, and half as many follow.
const MOST_NUMBERS: usize = 4_000_000;
/// Time after which no run goes on (time scales of the scene).
const FOREVER: f64 = 1e5;
/// Fluid shown around the bodies of a region without an end (length scales of the scene).
const MARGIN: f64 = 4.0;
/// Number of cells of the flow along the longer side of the picture.
const CELLS: f64 = 56.0;
/// Cells of the flow in pictures that are kept.
const FINE_CELLS: f64 = 160.0;
/// Columns of the table that are plotted.
const PLOTTED: [&str; 3] = ["speed", "aspect_ratio_moments", "stresslet_xx"];

/// A scene with what has been recorded of it.
#[derive(Debug)]
pub struct Live {
    /// Description, with suspensions as such.
    described: Setup,
    /// Description with all droplets at their places.
    placed: Setup,
    built: Built,
    meters: Vec<DropletMeter>,
    /// Rows of all droplets, row after row, each record with one row a droplet.
    rows: Vec<f64>,
    interval: f64,
    /// Intervals that have been reached.
    reached: f64,
    doubts: Vec<Doubt>,
}

/// Doubt about states since the last change of a parameter, one for each cause.
#[derive(Debug, Clone)]
pub struct Doubt {
    /// The worst warning.
    pub warning: Warning,
    /// Last time of a record that it is about (time).
    pub until: f64,
    /// True if it is about the last record.
    pub present: bool,
}

impl Live {
    /// Scene of a description, at its start.
    ///
    /// # Errors
    /// Those of [`Setup::build`].
    pub fn new(described: Setup) -> Result<Self, Refusal> {
        let placed = described.placed()?;
        let built = placed.build()?;
        if built.scene.system().all_bodies().next().is_none() {
            return Err(Refusal::plain("the scene has no droplet. Add a line to the text: [[droplets]]"));
        }
        let interval = ROW * placed.time_scale();
        let mut live = Self {
            described,
            placed,
            built,
            meters: Vec::new(),
            rows: Vec::new(),
            interval,
            reached: -1.0,
            doubts: Vec::new(),
        };
        live.measure()?;
        live.record()?;
        Ok(live)
    }

    /// Makes the meters of the droplets.
    fn measure(&mut self) -> Result<(), Refusal> {
        let Built { scene, droplets, .. } = &mut self.built;
        let meters = droplets.iter().map(|&droplet| DropletMeter::of(scene.system_mut(), droplet));
        self.meters = meters.collect::<Result<_, _>>()?;
        Ok(())
    }

    /// Description that the scene has now.
    #[must_use]
    pub fn described(&self) -> &Setup {
        &self.described
    }

    /// Present time (time).
    #[must_use]
    pub fn time(&self) -> f64 {
        self.built.scene.time()
    }

    /// Steps so far.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.built.scene.steps()
    }

    /// Takes a step, of the length that the description asks for; with an end (time) the last step ends there. `false`
    /// where the end has been reached.
    ///
    /// # Errors
    /// Those of a run; the scene is then in its last good state.
    pub fn step(&mut self, end: Option<f64>) -> Result<bool, Refusal> {
        let before = self.steps();
        let end = end.unwrap_or(FOREVER * self.placed.time_scale());
        if end <= self.time() {
            return Ok(false);
        }
        match self.built.scene.run(end).most_steps(1).go() {
            Ok(()) | Err(SceneError::TooManySteps { .. }) => {}
            Err(error) => return Err(error.into()),
        }
        let moved = self.steps() > before;
        if moved {
            self.record()?;
        }
        Ok(moved)
    }

    /// Adds rows to the table where one is due: after the first step that reaches a multiple of the interval.
    fn record(&mut self) -> Result<(), Refusal> {
        let reached = (self.time() / self.interval + 1e-9).floor();
        if reached <= self.reached {
            return Ok(());
        }
        self.reached = reached;
        self.doubt();
        let system = self.built.scene.system_mut();
        for meter in &self.meters {
            let record = meter.record(system)?;
            self.rows.extend(meter.row(&record));
        }
        if self.rows.len() > MOST_NUMBERS {
            let size = self.record_size();
            let kept = self.rows.chunks_exact(size).step_by(2).flatten().copied().collect();
            self.rows = kept;
            self.interval *= 2.0;
            self.reached = (self.time() / self.interval + 1e-9).floor();
        }
        Ok(())
    }

    /// Looks for doubts about the present state.
    fn doubt(&mut self) {
        let (found, time) = (self.built.scene.system_mut().warnings(), self.time());
        self.doubts.iter_mut().for_each(|doubt| doubt.present = false);
        for warning in found {
            let doubt = Doubt { warning, until: time, present: true };
            match self.doubts.iter_mut().find(|known| known.warning.cause == doubt.warning.cause) {
                Some(known) if known.warning.excess > doubt.warning.excess => {
                    (known.until, known.present) = (time, true);
                }
                Some(known) => *known = doubt,
                None => self.doubts.push(doubt),
            }
        }
    }

    fn record_size(&self) -> usize {
        self.meters.iter().map(|meter| meter.names().len()).sum::<usize>().max(1)
    }

    /// Number of records in the table.
    #[must_use]
    pub fn records(&self) -> usize {
        self.rows.len() / self.record_size()
    }

    /// Series of the records from one on: time, then speed (length per time), aspect ratio and stresslet xx
    /// (force times length) of each droplet.
    #[must_use]
    pub fn series(&self, from: usize) -> Vec<f64> {
        let mut series = Vec::new();
        for record in self.rows.chunks_exact(self.record_size()).skip(from) {
            let mut rest = record;
            for (number, meter) in self.meters.iter().enumerate() {
                let (row, others) = rest.split_at(meter.names().len());
                rest = others;
                if number == 0 {
                    series.push(row[0]);
                }
                let column = |name| meter.names().iter().position(|known| *known == name);
                series.extend(PLOTTED.map(|name| column(name).map_or(f64::NAN, |column| row[column])));
            }
        }
        series
    }

    /// The table as CSV: of one droplet that of `TrajectoryCsv`, of several that of `DropletsCsv`.
    #[must_use]
    pub fn csv(&self) -> String {
        let Some(first) = self.meters.first() else { return String::new() };
        let several = self.meters.len() > 1;
        let mut names = first.names().to_vec();
        if several {
            names.insert(1, "droplet");
        }
        let mut text = names.join(",") + "\n";
        for record in self.rows.chunks_exact(self.record_size()) {
            let mut rest = record;
            for (meter, droplet) in self.meters.iter().zip(&self.built.droplets) {
                let (row, others) = rest.split_at(meter.names().len());
                rest = others;
                let mut row = row.to_vec();
                if several {
                    row.insert(1, droplet.index() as f64);
                }
                text += &(CsvTable::line(&row) + "\n");
            }
        }
        text
    }

    /// Speed of a droplet in the present state (length per time); `None` where there is no such droplet.
    ///
    /// # Errors
    /// A flow that cannot be computed.
    pub fn speed(&mut self, droplet: usize) -> Result<Option<f64>, Refusal> {
        let Built { scene, droplets, .. } = &mut self.built;
        let Some(&droplet) = droplets.get(droplet) else { return Ok(None) };
        Ok(Some(scene.observe(droplet)?.speed()))
    }

    /// Doubts about the states since the last change of a parameter.
    #[must_use]
    pub fn doubts(&self) -> &[Doubt] {
        &self.doubts
    }

    /// Goes on with another value of a parameter, from the present state.
    ///
    /// # Errors
    /// A scene without that parameter, and values for which there is none; the scene is then as it was.
    pub fn turn(&mut self, knob: Knob, value: f64) -> Result<(), Refusal> {
        let (described, placed) = (knob.turned(&self.described, value)?, knob.turned(&self.placed, value)?);
        let mut built = placed.build()?;
        built.scene.take_over(&self.built.scene.checkpoint(""))?;
        (self.described, self.placed, self.built) = (described, placed, built);
        self.doubts.clear();
        self.measure()
    }

    /// Number of the droplet that a point (length) is in, in any of its periodic images.
    #[must_use]
    pub fn droplet_at(&self, point: Vec2) -> Option<usize> {
        let domain = self.built.scene.system().hydrodynamics().fluid_view().domain;
        let holds = |&droplet: &Handle<ActiveDroplet>| {
            let Ok(droplet) = self.built.scene.body(droplet) else { return false };
            let markers = droplet.markers();
            let centre = markers[0] + polygon::area_and_arm(markers).1;
            polygon::contains(markers, centre + nearest_image(point - centre, domain.periods))
        };
        self.built.droplets.iter().position(holds)
    }

    /// Moves a droplet, and what is in it, by a displacement (length); along the axis where that is one of symmetry.
    ///
    /// # Errors
    /// A place where it overlaps something, a droplet that is not there or is full of gel; the scene is then as it was.
    pub fn drag(&mut self, droplet: usize, by: Vec2) -> Result<(), Refusal> {
        let by = if self.described.region.is_axisymmetric() { Vec2::new(by.x, 0.0) } else { by };
        let missing = || Refusal::plain(format!("there is no droplet {droplet}"));
        let handle: Handle<dyn Body> = (*self.built.droplets.get(droplet).ok_or_else(missing)?).into();
        let system = self.built.scene.system();
        let outline = markers(system.any_body(handle)?);
        let inside = |(other, body): &(Handle<dyn Body>, &dyn Body)| {
            let first = markers(*body).first().copied();
            *other == handle || first.is_some_and(|first| polygon::contains(&outline, first))
        };
        let moved: Vec<Handle<dyn Body>> = system.all_bodies().filter(inside).map(|(handle, _)| handle).collect();
        Ok(self.built.scene.translate(&moved, by)?)
    }

    /// Raster over the picture with so many cells along its longer side.
    fn raster(&mut self, cells: f64) -> Result<Raster, Refusal> {
        let (region, margin) = (self.placed.region, MARGIN * self.placed.length_scale());
        let system = self.built.scene.system_mut();
        Ok(match region {
            Region::Tube { radius, .. } => {
                system.evaluate()?;
                let places = system.markers().positions().iter().map(|place| place.x);
                let [low, high] = places.fold([f64::INFINITY, -f64::INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
                let size = [high - low + 2.0 * margin, 2.0 * radius];
                let spacing = size[0].max(size[1]) / cells;
                let cells = size.map(|side| (side / spacing).ceil().max(1.0) as usize);
                Raster::new([low - margin, -radius], size, cells, [false; 2])?
            }
            Region::Box { lengths: [a, b] } | Region::Channel { length: a, width: b, .. } => {
                Raster::of(system, a.max(b) / cells)?
            }
            // The plane, space, and regions whose size the page does not know: what is around the bodies.
            _ => {
                system.evaluate()?;
                let spacing = margin * 3.0 / cells;
                Raster::around(system, margin, spacing)?
            }
        })
    }

    /// Everything in the present state, with the flow on a coarse raster.
    ///
    /// # Errors
    /// A flow that cannot be computed.
    pub fn seen(&mut self) -> Result<Snapshot, Refusal> {
        let raster = self.raster(CELLS)?;
        Ok(Snapshot::take(self.built.scene.system_mut(), raster)?)
    }

    /// Everything in the present state but the flow.
    ///
    /// # Errors
    /// A flow that cannot be computed.
    pub fn outlined(&mut self) -> Result<Snapshot, Refusal> {
        let raster = self.raster(1.0)?;
        Ok(Snapshot::of_bodies(self.built.scene.system(), raster)?)
    }

    /// Derivative of the tension along the interface at the markers of all droplets (force per length), in the order of
    /// [`crate::frame::shapes`].
    #[must_use]
    pub fn tension_gradients(&self) -> Vec<f32> {
        let gradient = |(_, droplet): (_, &ActiveDroplet)| {
            crate::frame::tension_gradient(droplet.tensions(), droplet.element_lengths())
        };
        self.built.scene.system().bodies().flat_map(gradient).collect()
    }

    /// Picture of the present state as SVG, drawn by `motile-output`.
    ///
    /// # Errors
    /// A flow that cannot be computed.
    pub fn svg(&mut self) -> Result<String, Refusal> {
        let raster = self.raster(FINE_CELLS)?;
        let seen = Snapshot::take(self.built.scene.system_mut(), raster)?;
        Ok(Look { caption: format!("t = {}", decimals(4, self.time())), ..Look::of(&self.placed) }.svg(&seen, &[])?)
    }

    /// Heights of the rigid walls, the periods and the corner of the region (length), as far as it has them.
    #[must_use]
    pub fn domain(&self) -> motile::scene::Domain {
        self.built.scene.system().hydrodynamics().fluid_view().domain
    }
}

fn markers(body: &dyn Body) -> Vec<Vec2> {
    let mut markers = vec![Vec2::ZERO; body.marker_count()];
    body.write_markers(&mut markers);
    markers
}
