package io.furrow.bench.load;

/** One hop of a measure, between two timestamps. */
public enum Hop {
    DEVICE_TO_SOURCE("device → source"),
    SOURCE_TO_INGEST("source → ingest"),
    INGEST_TO_READER("ingest → reader"),
    END_TO_END("end to end");

    private final String title;

    Hop(String title) {
        this.title = title;
    }

    public String title() {
        return title;
    }
}
