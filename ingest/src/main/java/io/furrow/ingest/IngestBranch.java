package io.furrow.ingest;

import java.util.Locale;

/** The parts of the work of {@code ingest} on each event: several instances of the job may divide them. */
enum IngestBranch {
    /** The topics of domains and missions, and the dead letters of the input. */
    ROUTES,
    /** {@code data.latest}. */
    LATEST,
    /** {@code data.catalog}. */
    CATALOG,
    /** Missions in MongoDB. */
    MISSIONS,
    /** The files of images, and {@code data.images}. */
    IMAGES;

    /** The name on the command line. */
    String code() {
        return name().toLowerCase(Locale.ROOT);
    }
}
