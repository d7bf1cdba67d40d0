package io.furrow.ingest.route;

import org.apache.flink.api.common.functions.MapFunction;

import io.furrow.model.event.HeaderNames;

/** Stamps {@code ts-ingest} with the wall clock, to measure the delay of each hop. */
public final class StampIngest implements MapFunction<ReportedEvent, ReportedEvent> {
    private static final long serialVersionUID = 1L;

    @Override
    public ReportedEvent map(ReportedEvent event) {
        return event.as(event.record().with(HeaderNames.TS_INGEST, Long.toString(System.currentTimeMillis())));
    }
}
