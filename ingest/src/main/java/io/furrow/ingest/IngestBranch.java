package io.furrow.ingest;

import java.util.Locale;

/** What {@code ingest} makes of events, each for itself: one instance of the job may do some of it and another the rest. */
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

    /** As the command line names it. */
    String code() {
        return name().toLowerCase(Locale.ROOT);
    }
}
