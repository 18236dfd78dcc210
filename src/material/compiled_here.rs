//! Laws of the library that are compiled with it.
//!
//! What is asked of a law is generic in the law and would be compiled anew in every crate that uses one: a kernel for each request and kind of
//! lane. A method that is not generic, of a type that is not, is compiled where it is written.

/// Overrides the sums of a law by the same, compiled here: `compiled_here!(perform)`, and `perform_stress_free` as well for a law that is wanted
/// without its pressure.
macro_rules! compiled_here {
    (perform) => {
        #[inline(never)]
        fn perform(
            &self,
            task: &mut crate::material::Task<'_>,
        ) -> crate::error::Result<crate::material::Response> {
            task.perform(self)
        }
    };
    (perform_stress_free) => {
        #[inline(never)]
        fn perform_stress_free(
            &self,
            task: &mut crate::material::Task<'_>,
        ) -> crate::error::Result<crate::material::Response> {
            task.perform(&crate::material::stress_free::WithoutPressure(self))
        }
    };
    (perform_sectional) => {
        #[inline(never)]
        fn perform(
            &self,
            task: &mut crate::material::Task<'_>,
        ) -> crate::error::Result<crate::material::Response> {
            task.perform_sectional(self)
        }
    };
}

pub(super) use compiled_here;
