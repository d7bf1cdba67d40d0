package io.furrow.model.result;

/**
 * Names of entities on {@code data.coverage}, the area of a field that robots have worked, and on {@code data.coverage.layer},
 * which shows where.
 */
public final class CoverageResult {
    public static final String TYPE = ResultTypes.PREFIX + "Coverage";
    /** Type for the cells of a field. */
    public static final String LAYER_TYPE = ResultTypes.PREFIX + "CoverageLayer";

    /** Id of the robot's entity; empty for all robots of the mission together. */
    public static final String DEVICE = "device";
    /** Type of the robot's entity; empty for all robots. */
    public static final String DEVICE_TYPE = "deviceType";
    /** Id of the field. */
    public static final String FIELD = "field";
    /** Name of the field, if it has one. */
    public static final String FIELD_NAME = "fieldName";
    /** Epoch ms, begin of the field's version. */
    public static final String FIELD_VERSION = "fieldVersion";
    /** Epoch ms; all swaths that ended by then are included. */
    public static final String TIME = "time";
    /** Epoch ms, begin of the first swath. */
    public static final String START_TIME = "startTime";
    /** Epoch ms, end of the last swath. */
    public static final String END_TIME = "endTime";
    /** Hectares of the field that are covered. */
    public static final String HECTARES = "hectares";
    /** The same as a share of the field, 0 to 1. */
    public static final String SHARE = "share";
    /** Hectares that were covered again. */
    public static final String OVERLAP = "overlapHectares";
    /** Hectares in gaps between covered cells; not of a single robot. */
    public static final String GAPS = "gapHectares";
    /** Hectares of the field. */
    public static final String FIELD_HECTARES = "fieldHectares";
    /** Hectares that are newly covered in an hour; null if unknown. */
    public static final String RATE = "hectaresPerHour";
    /** Milliseconds until the field is covered at this rate; null if unknown; not of a single robot. */
    public static final String TIME_LEFT = "timeLeft";
    /** Side of a cell, meters. */
    public static final String CELL = "cell";

    /** West, south, east and north of the raster, degrees. */
    public static final String BOX = "box";
    /** Number of cells of the raster from west to east. */
    public static final String COLUMNS = "columns";
    /** Number of cells of the raster from south to north. */
    public static final String ROWS = "rows";
    /** Base64 of the runs of cells of one code: 0 not covered, 1 covered, 2 covered again, 3 gap. */
    public static final String RUNS = "runs";

    private CoverageResult() {}
}
