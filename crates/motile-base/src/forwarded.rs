//! Methods of traits for what points at an implementation.

/// Implements methods of a trait for a pointer: each calls the method of this name of what it points at.
#[doc(hidden)]
#[macro_export]
macro_rules! forwarded {
    (
        by &self: $(fn $name:ident($($argument:ident: $type:ty),*) $(-> $out:ty)?;)*
        by &mut self: $(fn $changing:ident($($given:ident: $kind:ty),*) $(-> $result:ty)?;)*
    ) => {
        $(fn $name(&self $(, $argument: $type)*) $(-> $out)? {
            (**self).$name($($argument),*)
        })*
        $(fn $changing(&mut self $(, $given: $kind)*) $(-> $result)? {
            (**self).$changing($($given),*)
        })*
    };
}
