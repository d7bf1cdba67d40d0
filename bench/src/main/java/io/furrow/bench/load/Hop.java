package io.furrow.bench.load;

/** A part of the way of a measure, between two timestamps. */
public enum Hop {
    DEVICE_TO_SOURCE("device → source"),
    SOURCE_TO_INGEST("source → ingest"),
    INGEST_TO_READER("ingest → reader"),
    /** From the notification on: what takes the place of the thesis' Draco, and Kafka. */
    SOURCE_TO_READER("source → reader"),
    END_TO_END("end to end");

    private final String title;

    Hop(String title) {
        this.title = title;
    }

    public String title() {
        return title;
    }
}
