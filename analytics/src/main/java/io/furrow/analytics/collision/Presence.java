package io.furrow.analytics.collision;

/** What a device is to a grid cell. */
public enum Presence {
    /** It stands in the cell. */
    RESIDENT,
    /** It stands in a lesser cell, and its surroundings touch this one. */
    HALO,
    /** Neither any more. */
    GONE
}
