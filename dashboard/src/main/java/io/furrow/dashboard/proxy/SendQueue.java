package io.furrow.dashboard.proxy;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Iterator;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Queue;

import io.furrow.dashboard.feed.FeedRecord;
import io.furrow.dashboard.feed.StreamCounters;
import io.furrow.dashboard.feed.StreamCounters.Count;
import io.furrow.dashboard.feed.StreamLimits;

/**
 * What waits to be sent on one stream, within bounds. What is offered before the known state is there waits behind it. Frames are
 * taken one after the other, by whoever sends them.
 */
final class SendQueue {
    private static final int FRAME_CHARS = 256 * 1024;

    private final StreamRequest request;
    private final StreamLimits limits;
    private final StreamCounters counters;
    private final Queue<FeedRecord> initial = new ArrayDeque<>();
    private final Queue<FeedRecord> all = new ArrayDeque<>();
    private final Map<String, FeedRecord> latest = new LinkedHashMap<>();
    private final Queue<String> notes = new ArrayDeque<>();
    private long bytes;
    private long merged;
    private boolean priming;
    private boolean overflown;

    SendQueue(StreamRequest request, StreamLimits limits, StreamCounters counters) {
        this.request = request;
        this.limits = limits;
        this.counters = counters;
        this.priming = request.prime();
    }

    /** @return false if more wait than may: the stream is to be closed */
    synchronized boolean offer(FeedRecord record) {
        if (request.mode() == StreamRequest.Mode.ALL) {
            all.add(record);
        } else {
            String key = record.key();
            // what comes after a deletion stays behind it
            FeedRecord before = latest.containsKey(record.ofAllTypes()) ? latest.remove(key) : null;
            FeedRecord replaced = latest.put(key, record);
            before = before == null ? replaced : before;
            if (before != null) {
                bytes -= before.bytes();
                merged++;
                counters.add(Count.RECORDS_MERGED, 1);
            }
        }
        bytes += record.bytes();
        overflown = overflown || all.size() + latest.size() > limits.waitingRecords() || bytes > limits.waitingBytes();
        return !overflown;
    }

    /** What was known before. */
    synchronized void prime(List<FeedRecord> records) {
        initial.addAll(records);
        if (request.format() == StreamRequest.Format.RECORD) {
            // sent behind them, as the known records leave one frame after the other
            notes.add("{\"primed\":true}");
        }
        priming = false;
    }

    /** A frame of its own, of few signs. */
    synchronized void note(String frame) {
        notes.add(frame);
    }

    /** The next frame; null if nothing waits. */
    synchronized String take() {
        if (!initial.isEmpty()) {
            return frame(initial.iterator(), false);
        } else if (!notes.isEmpty()) {
            return notes.remove();
        } else if (priming || all.isEmpty() && latest.isEmpty()) {
            return null;
        }
        return frame(all.isEmpty() ? latest.values().iterator() : all.iterator(), true);
    }

    private String frame(Iterator<FeedRecord> waiting, boolean counted) {
        if (request.format() == StreamRequest.Format.VALUE) {
            counters.add(Count.RECORDS_SENT, 1);
            return taken(waiting, counted).text();
        }
        List<String> records = new ArrayList<>();
        int chars = 0;
        while (waiting.hasNext() && chars < FRAME_CHARS) {
            String record = taken(waiting, counted).envelope();
            records.add(record);
            chars += record.length();
        }
        counters.add(Count.RECORDS_SENT, records.size());
        String tail = counted && merged > 0 ? "],\"merged\":" + merged + "}" : "]}";
        merged = counted ? 0 : merged;
        return "{\"records\":[" + String.join(",", records) + tail;
    }

    private FeedRecord taken(Iterator<FeedRecord> waiting, boolean counted) {
        FeedRecord record = waiting.next();
        waiting.remove();
        bytes -= counted ? record.bytes() : 0;
        return record;
    }
}
