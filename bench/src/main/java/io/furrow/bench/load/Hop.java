package io.furrow.bench.load;

import java.util.function.ToLongFunction;

/** A part of a measure's path, between two timestamps. */
public enum Hop {
    DEVICE_TO_SOURCE("device → source", passage -> passage.source() - passage.device()),
    SOURCE_TO_INGEST("source → ingest", passage -> passage.ingest() - passage.source()),
    INGEST_TO_READER("ingest → reader", passage -> passage.reader() - passage.ingest()),
    /** From the notification on: the counterpart of the thesis' Draco, and Kafka. */
    SOURCE_TO_READER("source → reader", passage -> passage.reader() - passage.source()),
    END_TO_END("end to end", passage -> passage.reader() - passage.device());

    private final String title;
    private final ToLongFunction<Arrivals.Passage> delay;

    Hop(String title, ToLongFunction<Arrivals.Passage> delay) {
        this.title = title;
        this.delay = delay;
    }

    public String title() {
        return title;
    }

    long delay(Arrivals.Passage passage) {
        return delay.applyAsLong(passage);
    }
}
