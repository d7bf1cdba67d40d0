package io.furrow.cli.control;

import com.fasterxml.jackson.databind.JsonNode;

/**
 * The part of its recording that a replay plays: within its plan, and within its range if it has one.
 *
 * @param from event time of the beginning, epoch ms
 * @param to event time of the end, epoch ms
 * @param last greatest event time for a seek, epoch ms
 */
record PlayedRange(long from, long to, long last) {
    /** @param replay as the control plane reports it */
    static PlayedRange of(JsonNode replay) {
        JsonNode progress = replay.at("/status/progress");
        long from = progress.path("from").asLong();
        long to = progress.path("to").asLong();
        long last = to;
        for (JsonNode bounds : new JsonNode[] {replay, replay.path("range")}) {
            long end = bounds.path("to").asLong(Long.MAX_VALUE);
            from = Math.max(from, bounds.path("from").asLong(from));
            to = Math.min(to, end);
            last = Math.min(last, end - 1); // the end itself is not played
        }
        return new PlayedRange(from, to, last);
    }

    /** Progress from 0 to 1; 0 if unknown. @param position event time, epoch ms */
    double share(long position) {
        return to <= from ? 0 : Math.max(0, Math.min(1, (position - from) / (double) (to - from)));
    }
}
