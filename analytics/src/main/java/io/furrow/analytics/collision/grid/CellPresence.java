package io.furrow.analytics.collision.grid;

import java.io.IOException;

/** The role of a device in a grid cell. */
public enum CellPresence {
    /** Its position is in the cell. */
    RESIDENT(0),
    /** Its position is in a cell with a lesser id, and its surroundings touch this one. */
    HALO(1),
    /** Neither any longer. */
    GONE(2);

    private final int code;

    CellPresence(int code) {
        this.code = code;
    }

    /** The code in savepoints; never changes. */
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
