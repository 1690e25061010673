//! The kernel of a stepper.

use super::Kernel;
use lcplab_solver::Status;
use lcplab_solver::kernel::Width;
use lcplab_solver::kernel::impulses::{RowByRow, SimdPairs, System, Velocity};

/// Something that sweeps, and the velocities it ended with.
pub(super) struct Sweeper {
    form: Form,
    pub v: Vec<Velocity>,
}

enum Form {
    RowByRow(RowByRow),
    SimdPairs(Box<SimdPairs>),
}

impl Sweeper {
    pub fn new(kernel: Kernel) -> Self {
        let form = match kernel {
            Kernel::RowByRow => Form::RowByRow(RowByRow::default()),
            Kernel::SimdPairs { threads } => {
                Form::SimdPairs(Box::new(SimdPairs::idle(Width::widest(), threads)))
            }
        };
        Sweeper { form, v: Vec::new() }
    }

    /// Does the given number of sweeps from x and from the velocities without x; leaves the new x.
    pub fn sweep(
        &mut self,
        system: &System,
        x: &mut [f64],
        free: &[Velocity],
        count: usize,
    ) -> Result<(), Status> {
        self.v.resize(free.len(), Velocity::default());
        match &mut self.form {
            Form::RowByRow(kernel) => {
                kernel.start(system, x, free);
                (0..count).for_each(|_| kernel.sweep(system));
                x.copy_from_slice(kernel.x());
                self.v.copy_from_slice(kernel.v());
            }
            Form::SimdPairs(kernel) => {
                kernel.start(system, x, free)?;
                kernel.sweeps(count);
                kernel.write_x(x);
                kernel.write_v(&mut self.v);
            }
        }
        Ok(())
    }

    /// The given number of rows in the order in which they are swept.
    pub fn order(&self, rows: usize) -> Vec<usize> {
        match &self.form {
            Form::RowByRow(_) => (0..rows).collect(),
            Form::SimdPairs(kernel) => kernel.order(),
        }
    }
}
