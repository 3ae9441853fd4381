//! Four numbers at once, with the instructions of the machine.

/// Arithmetic on four numbers. Every implementation rounds each operation once, so that all give the same bits: no fused
/// multiply-add.
pub(super) trait Lanes: Copy {
    /// The four numbers.
    type Four: Copy;

    /// Four times the same number.
    fn splat(self, value: f64) -> Self::Four;

    /// The numbers of an array.
    fn load(self, values: [f64; 4]) -> Self::Four;

    /// As an array.
    fn store(self, four: Self::Four) -> [f64; 4];

    /// `a + b`, each with each.
    fn add(self, a: Self::Four, b: Self::Four) -> Self::Four;

    /// `a b`, each with each.
    fn mul(self, a: Self::Four, b: Self::Four) -> Self::Four;
}

/// What every machine has.
#[derive(Debug, Clone, Copy)]
pub(super) struct Portable;

impl Lanes for Portable {
    type Four = [f64; 4];

    #[inline(always)]
    fn splat(self, value: f64) -> [f64; 4] {
        [value; 4]
    }

    #[inline(always)]
    fn load(self, values: [f64; 4]) -> [f64; 4] {
        values
    }

    #[inline(always)]
    fn store(self, four: [f64; 4]) -> [f64; 4] {
        four
    }

    #[inline(always)]
    fn add(self, a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
        [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]]
    }

    #[inline(always)]
    fn mul(self, a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
        [a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]]
    }
}

#[cfg(target_arch = "x86_64")]
impl Lanes for pulp::x86::V3 {
    type Four = pulp::f64x4;

    #[inline(always)]
    fn splat(self, value: f64) -> pulp::f64x4 {
        self.splat_f64x4(value)
    }

    #[inline(always)]
    fn load(self, values: [f64; 4]) -> pulp::f64x4 {
        pulp::cast(values)
    }

    #[inline(always)]
    fn store(self, four: pulp::f64x4) -> [f64; 4] {
        pulp::cast(four)
    }

    #[inline(always)]
    fn add(self, a: pulp::f64x4, b: pulp::f64x4) -> pulp::f64x4 {
        self.add_f64x4(a, b)
    }

    #[inline(always)]
    fn mul(self, a: pulp::f64x4, b: pulp::f64x4) -> pulp::f64x4 {
        self.mul_f64x4(a, b)
    }
}

/// Work that is compiled once for every set of instructions.
pub(super) trait LanesTask {
    /// Does it.
    fn run<L: Lanes>(self, lanes: L);
}

/// Does `task` with the widest instructions that the machine has.
pub(super) fn dispatch<T: LanesTask>(task: T) {
    #[cfg(target_arch = "x86_64")]
    if let Some(wide) = pulp::x86::V3::try_new() {
        struct Wide<T>(pulp::x86::V3, T);
        impl<T: LanesTask> pulp::NullaryFnOnce for Wide<T> {
            type Output = ();

            #[inline(always)]
            fn call(self) {
                self.1.run(self.0);
            }
        }
        wide.vectorize(Wide(wide, task));
        return;
    }
    task.run(Portable);
}
