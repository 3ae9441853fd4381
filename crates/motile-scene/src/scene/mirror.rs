//! Scenes that are held to be their own mirror image in y = 0.

use std::ops::Range;

use motile_base::Vec2;

use crate::{Body, Hydrodynamics, SceneError, System, integrator::Dynamics};

/// Distance of a marker from the image of its counterpart over the extent of the body, above which it is none; the same
/// for properties, over their values.
const SAME: f64 = 1e-6;
/// Largest change of an entry of the state in one step, over its scale, that is taken for round-off or for what an
/// iteration leaves.
const ROUND_OFF: f64 = 1e-6;

/// A body and its image, which may be the same body: their numbers, and of the image of each marker of one the number
/// in the other.
#[derive(Debug, Clone)]
struct Pair {
    bodies: [usize; 2],
    markers: [Vec<usize>; 2],
}

/// Bodies in pairs of mirror images.
#[derive(Debug, Clone, Default)]
pub(crate) struct Mirror {
    pairs: Vec<Pair>,
    /// Ranges of the states of the bodies in the state of the scene.
    ranges: Vec<Range<usize>>,
    state: Vec<f64>,
    scales: Vec<f64>,
    image: Vec<f64>,
}

impl Mirror {
    /// Finds the mirror image of each body of a scene, and makes the scene symmetric to round-off.
    ///
    /// # Errors
    /// Returns [`SceneError::NotSymmetric`] if a body has no mirror image.
    pub(crate) fn of<H: Hydrodynamics>(system: &mut System<H>) -> Result<Self, SceneError> {
        let mut mirror = Self::default();
        mirror.find(system)?;
        mirror.project(system)?;
        Ok(mirror)
    }

    fn find<H: Hydrodynamics>(&mut self, system: &System<H>) -> Result<(), SceneError> {
        (self.pairs, self.ranges) = (Vec::new(), Vec::new());
        let bodies: Vec<&dyn Body> = system.all_bodies().map(|(_, body)| body).collect();
        let places: Vec<Vec<Vec2>> = bodies.iter().map(|body| places(*body)).collect();
        let mut single = vec![true; bodies.len()];
        for (one, body) in bodies.iter().enumerate() {
            let start = self.ranges.last().map_or(0, |range| range.end);
            self.ranges.push(start..start + body.state_len());
            let problem = |problem| {
                Err(SceneError::NotSymmetric { time: system.time(), body: system.bodies.name_of(one), problem })
            };
            let own: Vec<usize> = (0..body.marker_count()).collect();
            let state = vec![0.0; body.state_len()];
            if !body.mirror(&own, &state, &mut state.clone()) {
                return problem(
                    "is of a kind that has no mirror images, as an interface along x, a mesh or a gel inside, a solid \
                     that relaxes, twitches or spreads its forces"
                        .to_owned(),
                );
            }
            if !single[one] {
                continue;
            }
            let mut nearest = (f64::INFINITY, Vec2::ZERO);
            let mut image = None;
            let alike = |other: &usize| single[*other] && bodies[*other].state_len() == body.state_len();
            for other in (one..bodies.len()).filter(alike) {
                match images(&places[one], &places[other]) {
                    Ok(markers) => {
                        image = Some((other, markers));
                        break;
                    }
                    Err(found) => nearest = if found.0 < nearest.0 { found } else { nearest },
                }
            }
            let Some((other, markers)) = image else {
                let (distance, Vec2 { x, y }) = nearest;
                return problem(format!(
                    "has no mirror image: that of its marker at ({x:.4}, {y:.4}) is {distance:.1e} from the nearest \
                     marker of a body of as many"
                ));
            };
            if let Some((name, [here, there])) = other_property(*body, bodies[other]) {
                return problem(format!("has another mirror image: {name} is {here} of one and {there} of the other"));
            }
            let mut back = vec![0; markers.len()];
            markers.iter().enumerate().for_each(|(marker, &image)| back[image] = marker);
            (single[one], single[other]) = (false, false);
            self.pairs.push(Pair { bodies: [one, other], markers: [markers, back] });
        }
        Ok(())
    }

    /// Takes each body and its image to the mean of the two.
    ///
    /// # Errors
    /// Returns [`SceneError::NotSymmetric`] if this changes a state by more than round-off.
    pub(crate) fn project<H: Hydrodynamics>(&mut self, system: &mut System<H>) -> Result<(), SceneError> {
        if self.ranges.len() != system.all_bodies().len() {
            self.find(system)?;
        }
        system.write_state(&mut self.state);
        self.scales.resize(self.state.len(), 1.0);
        system.write_scales(&mut self.scales);
        let Self { pairs, ranges, state, scales, image } = self;
        for Pair { bodies: [one, other], markers: [markers, back] } in pairs {
            let body = |index: usize| system.all_bodies().nth(index).map(|(_, body)| body);
            let (Some(first), Some(second)) = (body(*one), body(*other)) else { continue };
            let (from, to) = (ranges[*one].clone(), ranges[*other].clone());
            image.resize(from.len(), 0.0);
            first.mirror(markers, &state[from.clone()], image);
            let mut most = 0.0_f64;
            for ((value, image), scale) in state[to.clone()].iter_mut().zip(&*image).zip(&scales[to.clone()]) {
                most = most.max((*value - image).abs() / scale);
                *value = 0.5 * (*value + image);
            }
            if most > ROUND_OFF {
                let (time, body) = (system.time(), system.bodies.name_of(*one));
                let problem = format!("has come off its mirror image by {most:.1e} of its size");
                return Err(SceneError::NotSymmetric { time, body, problem });
            }
            second.mirror(back, &state[to], image);
            state[from].copy_from_slice(image);
        }
        system.read_state(state)
    }
}

/// Returns the marker positions of a body (length).
fn places(body: &dyn Body) -> Vec<Vec2> {
    let mut places = vec![Vec2::ZERO; body.marker_count()];
    body.write_markers(&mut places);
    places
}

/// Returns the number of the image of each point of one list in another, or a point without one and how far its image
/// is from the nearest of them.
fn images(one: &[Vec2], other: &[Vec2]) -> Result<Vec<usize>, (f64, Vec2)> {
    if one.len() != other.len() {
        return Err((f64::INFINITY, one.first().copied().unwrap_or_default()));
    }
    let extent = one.iter().map(|place| place.distance(one[0])).fold(0.0, f64::max);
    let mut taken = vec![false; other.len()];
    let image = |place: &Vec2| {
        let image = Vec2::new(place.x, -place.y);
        let nearest = other.iter().map(|place| place.distance(image)).enumerate();
        let nearest = nearest.fold((0, f64::INFINITY), |least, found| if found.1 < least.1 { found } else { least });
        let (number, distance) = nearest;
        let free = !std::mem::replace(taken.get_mut(number)?, true);
        Some(if free && distance <= SAME * extent { Ok(number) } else { Err((distance, *place)) })
    };
    one.iter().filter_map(image).collect()
}

/// Returns a property of which a body and its image have different amounts.
fn other_property(one: &dyn Body, other: &dyn Body) -> Option<(String, [String; 2])> {
    let shown = |value: Option<f64>| value.map_or_else(|| "not given".to_owned(), |value| value.to_string());
    let (here, there) = (one.properties(), other.properties());
    let names = here.iter().chain(&there).map(|(name, _)| name);
    let of = |list: &[(String, f64)], name: &String| list.iter().find(|(other, _)| other == name).map(|(_, v)| *v);
    names.map(|name| (name, [of(&here, name), of(&there, name)])).find_map(|(name, values)| {
        // What has a direction may have the opposite one in the image: if it should not, the first step tells.
        let same = matches!(values, [Some(a), Some(b)] if (a.abs() - b.abs()).abs() <= SAME * a.abs().max(b.abs()));
        (!same).then(|| (name.clone(), values.map(shown)))
    })
}

#[cfg(test)]
mod tests;
