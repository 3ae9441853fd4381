//! Numbers without measure: every constructor ends in a typed error or in something of bounded size.

use allocation_counter::measure;
use elastic_solids::ChannelShape;
use elastic_solids::mesh::{equilateral_block, equilateral_strip, fitted_strip};
use elastic_solids::{Channel, Interior, Mesher, Outline, SolidError};
use motile_base::Vec2;

/// Numbers that a length or a count times one may be. Below 1e-154 squares vanish, above 1e154 they are infinite.
const LENGTHS: [f64; 14] =
    [1e-308, 1e-300, 1e-200, 1e-161, 1e-160, 1e-120, 1e-30, 1e-9, 1e6, 1e30, 1e120, 1e160, 1e300, f64::NAN];
const COUNTS: [usize; 4] = [1 << 20, 1 << 40, usize::MAX / 2, usize::MAX];
/// Bytes that no constructor may exceed.
const MOST: u64 = 400 << 20;

/// The outcome of a constructor, whose memory is looked at.
fn bounded<T>(name: &str, make: impl FnOnce() -> Result<T, SolidError>) -> Option<SolidError> {
    let mut outcome = None;
    let memory = measure(|| outcome = Some(make().err()));
    assert!(memory.bytes_max < MOST, "{name}: {} MB", memory.bytes_max >> 20);
    outcome.flatten()
}

fn refused<T>(name: &str, make: impl FnOnce() -> Result<T, SolidError>) {
    let error = bounded(name, make).unwrap_or_else(|| panic!("{name} is taken"));
    // Name and value, then a sentence on what to do.
    let text = error.to_string();
    assert!(text.split_once(". ").is_some_and(|(what, remedy)| what.contains(" is ") && !remedy.is_empty()), "{text}");
}

#[test]
fn channels_of_any_lengths() {
    for length in LENGTHS {
        for (period, width) in [(length, 2.0), (6.0, length), (length, length)] {
            let name = format!("period {period:e}, width {width:e}");
            bounded(&name, || ChannelShape::Straight { width }.channel(period));
            bounded(&name, || ChannelShape::Sinusoidal { width, amplitude: 0.3, waves: 2, phase: 0.1 }.channel(period));
            bounded(&name, || {
                ChannelShape::Constriction {
                    width,
                    throat: 1.0,
                    throat_length: 4.0,
                    ramp: 1.0,
                    exit_ramp: None,
                    centre: 0.0,
                }
                .channel(period)
            });
            bounded(&name, || {
                ChannelShape::Valve { width, gap: 0.2, base: 1.0, rounding: 0.0, centre: 0.0 }.channel(period)
            });
            let (throat, teeth) = (1.0, 2);
            for sharp in [false, true] {
                bounded(&name, || ChannelShape::Ratchet { width, throat, teeth, rise: 0.5, sharp }.channel(period));
            }
            let (branches, ramp) = ([1.0, 1.0], 1.0);
            bounded(&name, || {
                ChannelShape::Branching { width, branches, island_length: 2.0, island_thickness: 1.0, ramp }
                    .channel(period)
            });
        }
        let (period, width) = (6.0, 2.0);
        let name = format!("{length:e}");
        bounded(&name, || ChannelShape::Sinusoidal { width, amplitude: length, waves: 2, phase: 0.0 }.channel(period));
        bounded(&name, || {
            ChannelShape::Valve { width, gap: 0.2, base: length, rounding: length, centre: length }.channel(period)
        });
        bounded(&name, || {
            ChannelShape::Ratchet { width, throat: length, teeth: 3, rise: 0.5, sharp: true }.channel(period)
        });
        bounded(&name, || Channel::between(length, 6.0, |_| -1.0, |_| 1.0));
        bounded(&name, || {
            let far = Outline::polyline(&[Vec2::new(0.0, 1.0), Vec2::new(length, length)], 1.0)?;
            Channel::new(Outline::flat(0.0, 1.0, -1.0)?, far)
        });
    }
}

#[test]
fn channels_of_any_number_of_waves_and_teeth() {
    for count in COUNTS {
        let wavy = ChannelShape::Sinusoidal { width: 2.0, amplitude: 0.1, waves: count, phase: 0.0 };
        refused(&format!("{count} waves"), || wavy.channel(6.0));
        for sharp in [false, true] {
            let ratchet = ChannelShape::Ratchet { width: 2.0, throat: 1.0, teeth: count, rise: 0.5, sharp };
            refused(&format!("{count} teeth"), || ratchet.channel(6.0));
        }
    }
}

#[test]
fn lattices_of_any_size() {
    for count in COUNTS {
        for (columns, rows) in [(count, 4), (4, count), (count, count)] {
            let name = format!("{columns} by {rows}");
            refused(&name, || equilateral_block(Vec2::ZERO, columns, rows, 0.1));
            refused(&name, || equilateral_strip(Vec2::ZERO, columns, rows, 0.1));
        }
    }
    for length in LENGTHS {
        for (size, spacing) in [([length, 1.0], 0.1), ([1.0, length], 0.1), ([1.0, 1.0], length)] {
            bounded(&format!("{size:?} at {spacing:e}"), || fitted_strip(Vec2::ZERO, size, spacing));
        }
        bounded(&format!("{length:e}"), || equilateral_block(Vec2::ZERO, 8, 8, length));
    }
}

#[test]
fn outlines_and_meshes_of_any_spacing() {
    let disc = || Outline::circle(Vec2::ZERO, 1.0);
    for length in LENGTHS {
        let name = format!("{length:e}");
        bounded(&name, || disc()?.resampled(length));
        bounded(&name, || Outline::circle(Vec2::ZERO, length)?.resampled(0.1));
        bounded(&name, || Outline::circle(Vec2::new(length, -length), 1.0)?.mesh(0.2));
        bounded(&name, || Outline::ellipse(Vec2::ZERO, [length, 1.0])?.mesh(0.2));
        bounded(&name, || Outline::rectangle(Vec2::ZERO, Vec2::new(length, 1.0))?.mesh(0.2));
        bounded(&name, || disc()?.mesh(length));
        for (period, height, spacing) in [(length, 1.0, 0.2), (2.0, length, 0.2), (2.0, 1.0, length)] {
            let wall = || Interior::new([Outline::flat(0.0, period, 0.0)?, Outline::flat(0.0, period, height)?]);
            for angle in [0.0, 0.2] {
                let name = format!("a wall of {period:e} by {height:e} at {spacing:e}, turned by {angle}");
                bounded(&name, || Mesher::new(spacing)?.turned(angle)?.mesh(&wall()?));
            }
        }
    }
    // Just within the bounds of an outline, far beyond those of its inside.
    refused("a large disc", || Outline::circle(Vec2::ZERO, 1000.0)?.mesh(0.1));
    // The turned seeds of a long wall are a square about it.
    refused("a long wall", || {
        let wall = Interior::new([Outline::flat(0.0, 4e4, 0.0)?, Outline::flat(0.0, 4e4, 1.0)?])?;
        Mesher::new(1.0)?.turned(0.2)?.mesh(&wall)
    });
}
