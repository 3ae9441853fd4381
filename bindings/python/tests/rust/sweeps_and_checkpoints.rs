use motile::prelude::*;
use std::{error::Error, thread};

fn speed(activity: f64) -> Result<f64, Box<dyn Error + Send + Sync>> {
    let method = Method::Integral(IntegralMethod { nodes: 32, elements: 128 });
    let setup = Setup { method, droplets: vec![DropletSetup::active(activity)], ..Setup::default() };
    let Built { mut scene, droplets, .. } = setup.build()?;
    scene.run(2.0).go()?;
    Ok(scene.observe(droplets[0])?.speed())
}

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    let activities = [-1.5, -2.0, -3.0];
    let runs = activities.map(|activity| thread::spawn(move || speed(activity)));
    for (activity, run) in activities.into_iter().zip(runs) {
        match run.join().expect("a run does not panic") {
            Ok(speed) => println!("activity {activity}: speed {speed:.4}"),
            Err(error) => println!("activity {activity}: {error}"),
        }
    }
    Ok(())
}
