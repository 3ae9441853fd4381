//! Long computations that Ctrl-C can leave.

use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

use crate::error::failed;

/// Time between two looks at signals.
pub(crate) const BETWEEN_LOOKS: Duration = Duration::from_millis(50);

enum Heard<T> {
    Value(f64),
    Done(T),
}

/// Result of work in a thread of its own, with whose values on the way `tick` is called. After Ctrl-C or an exception
/// of `tick` nobody waits for the thread: it ends when it next has a value, at which it is told so by `false`, or at
/// its end.
pub(crate) fn unless_interrupted<T: Send + 'static>(
    py: Python<'_>,
    tick: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&dyn Fn(f64) -> bool) -> T + Send + 'static,
) -> PyResult<T> {
    let (sender, mut receiver) = mpsc::channel();
    thread::spawn(move || {
        let done = work(&|value| sender.send(Heard::Value(value)).is_ok());
        sender.send(Heard::Done(done))
    });
    loop {
        let heard;
        (receiver, heard) = py.detach(move || {
            let heard = receiver.recv_timeout(BETWEEN_LOOKS);
            (receiver, heard)
        });
        match heard {
            Ok(Heard::Done(done)) => return Ok(done),
            Ok(Heard::Value(value)) => tick.map_or(Ok(()), |tick| tick.call1((value,)).map(drop))?,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return Err(failed("the computation panicked: see standard error")),
        }
        py.check_signals()?;
    }
}
