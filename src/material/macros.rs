/// Writes an [`Isotropic`](crate::material::Isotropic) law in closure syntax.
///
/// Captured numbers are listed with their types and taken by copy from the variables of that name; the closure may also be
/// given a polynomial `degree`, which lets the section choose its quadrature, and be called `uniform` where it ignores `at.s`, so that a
/// quadratic one is integrated only once. It expands to a type and an implementation
/// of the trait, so it is as fast as one.
///
/// ```
/// let (c1, c2) = (30e3, 10e3);
/// let rubber = hyperrod::isotropic!([c1: f64, c2: f64] degree 2, uniform; |i, _at| i.i1_excess() * c1 + i.i2_excess() * c2);
/// # let _ = rubber;
/// ```
#[macro_export]
macro_rules! isotropic {
    ($([$($capture:ident : $type:ty),* $(,)?])? $(degree $degree:literal $(, $uniform:ident)?;)? |$i:ident, $at:ident| $body:expr) => {
        $crate::__law!(Isotropic, Invariants, ($($($capture : $type),*)?) ($($degree $(, $uniform)?)?) |$i, $at| $body)
    };
}

/// Writes a [`Local`](crate::material::Local) law in closure syntax. See [`isotropic!`](crate::isotropic!).
///
/// ```
/// let (young, shear) = (1e6, 3e5);
/// let fibres = hyperrod::local!([young: f64, shear: f64] degree 2; |f, _at| {
///     let g = f.gamma();
///     (g.x * g.x + g.y * g.y) * (0.5 * shear) + g.z * g.z * (0.5 * young)
/// });
/// # let _ = fibres;
/// ```
#[macro_export]
macro_rules! local {
    ($([$($capture:ident : $type:ty),* $(,)?])? $(degree $degree:literal $(, $uniform:ident)?;)? |$f:ident, $at:ident| $body:expr) => {
        $crate::__law!(Local, Deformation, ($($($capture : $type),*)?) ($($degree $(, $uniform)?)?) |$f, $at| $body)
    };
}

/// Writes a [`Sectional`](crate::material::Sectional) law in closure syntax. See [`isotropic!`](crate::isotropic!).
///
/// ```
/// let young = 1e6;
/// let law = hyperrod::sectional!([young: f64] degree 2; |strain, at| {
///     let e = strain.linear.z + strain.angular.x * at.y - strain.angular.y * at.x;
///     e * e * (0.5 * young)
/// });
/// # let _ = law;
/// ```
#[macro_export]
macro_rules! sectional {
    ($([$($capture:ident : $type:ty),* $(,)?])? $(degree $degree:literal $(, $uniform:ident)?;)? |$strain:ident, $at:ident| $body:expr) => {
        $crate::__law!(Sectional, __Strain, ($($($capture : $type),*)?) ($($degree $(, $uniform)?)?) |$strain, $at| $body)
    };
}

#[doc(hidden)]
#[macro_export]
macro_rules! __uniform {
    (uniform) => {
        true
    };
}

#[doc(hidden)]
#[macro_export]
macro_rules! __law {
    ($level:ident, $argument:ident, ($($capture:ident : $type:ty),*) ($($degree:literal $(, $uniform:ident)?)?) |$arg:ident, $at:ident| $body:expr) => {{
        #[allow(unused_imports)]
        use $crate::num_dual::DualNum as _;
        struct Law {
            $($capture: $type,)*
        }
        impl $crate::material::$level for Law {
            #[inline(always)]
            fn energy_density<D: $crate::Scalar>(
                &self,
                $arg: &$crate::material::$argument<D>,
                $at: &$crate::material::Point<D>,
            ) -> D {
                $(let $capture = self.$capture;)*
                $body
            }
            $(fn degree(&self) -> Option<usize> {
                Some($degree)
            }
            $(fn is_uniform(&self) -> bool {
                $crate::__uniform!($uniform)
            })?)?
        }
        Law { $($capture,)* }
    }};
}
