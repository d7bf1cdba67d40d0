package io.furrow.bench.load;

/** A part of the way of a measure, told by the stamps at both its ends. */
enum Hop {
    DEVICE_TO_SOURCE("device → source"),
    SOURCE_TO_INGEST("source → ingest"),
    INGEST_TO_READER("ingest → reader"),
    END_TO_END("end to end");

    private final String title;

    Hop(String title) {
        this.title = title;
    }

    String title() {
        return title;
    }
}
