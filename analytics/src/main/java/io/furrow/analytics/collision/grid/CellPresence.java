package io.furrow.analytics.collision.grid;

import java.io.IOException;

/** What a device is to a grid cell. */
public enum CellPresence {
    /** It stands in the cell. */
    RESIDENT(0),
    /** It stands in a lesser cell, and its surroundings touch this one. */
    HALO(1),
    /** Neither any more. */
    GONE(2);

    private final int code;

    CellPresence(int code) {
        this.code = code;
    }

    /** By which savepoints know it; never changes. */
    public int code() {
        return code;
    }

    /** @throws IOException if no presence has this code */
    public static CellPresence of(int code) throws IOException {
        return switch (code) {
            case 0 -> RESIDENT;
            case 1 -> HALO;
            case 2 -> GONE;
            default -> throw new IOException("no presence has the code " + code);
        };
    }
}
