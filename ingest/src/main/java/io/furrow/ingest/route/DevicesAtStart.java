package io.furrow.ingest.route;

import java.io.IOException;
import java.io.Serializable;
import java.util.List;

import io.furrow.flink.TopicRecord;

/** What is on {@code service.devices} at the moment of the call: no event is assigned before it has been read. */
public interface DevicesAtStart extends Serializable {
    /** For a job that does not look at devices. */
    DevicesAtStart NONE = List::of;

    List<TopicRecord> read() throws IOException;
}
