mod families;
mod friction;
mod page;
mod standard;
