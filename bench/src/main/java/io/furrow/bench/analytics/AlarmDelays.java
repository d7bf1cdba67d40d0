package io.furrow.bench.analytics;

import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.AtomicLongArray;

import org.HdrHistogram.ConcurrentHistogram;
import org.HdrHistogram.Histogram;
import org.apache.flink.api.connector.sink2.Sink;
import org.apache.flink.api.connector.sink2.SinkWriter;
import org.apache.flink.api.connector.sink2.WriterInitContext;

import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.position.PositionFix;
import io.furrow.bench.analytics.load.Fleet;

/** Nanoseconds from the arrival of the position that makes a pair close to its provisional record, within this JVM. */
public final class AlarmDelays {
    private static final ConcurrentHashMap<String, AlarmDelays> RUNS = new ConcurrentHashMap<>();
    private static final long MAX = 60_000_000_000L;

    private final AtomicLongArray arrivals;
    private final Histogram delays = new ConcurrentHistogram(MAX, 3);

    private AlarmDelays(int devices) {
        arrivals = new AtomicLongArray(devices);
    }

    static AlarmDelays start(String run, int devices) {
        AlarmDelays delays = new AlarmDelays(devices);
        RUNS.put(run, delays);
        return delays;
    }

    public static AlarmDelays of(String run) {
        return RUNS.get(run);
    }

    Histogram delays() {
        return delays;
    }

    public void arrived(PositionFix fix) {
        arrivals.set(Fleet.number(fix), System.nanoTime());
    }

    /** A device reports once a second: the newer arrival of the two is that of the position that made the pair close. */
    private void told(Encounter encounter) {
        if (encounter.phase() == Phase.PROVISIONAL) {
            long arrival = Math.max(
                    arrivals.get(Fleet.number(encounter.first())), arrivals.get(Fleet.number(encounter.second())));
            delays.recordValue(Math.min(MAX, Math.max(0, System.nanoTime() - arrival)));
        }
    }

    /** The end of a measured job. */
    record To(String run) implements Sink<Encounter> {
        private static final long serialVersionUID = 1L;

        @Override
        public SinkWriter<Encounter> createWriter(WriterInitContext context) {
            AlarmDelays delays = of(run);
            return new SinkWriter<>() {
                @Override
                public void write(Encounter encounter, Context ignored) {
                    delays.told(encounter);
                }

                @Override
                public void flush(boolean endOfInput) {}

                @Override
                public void close() {}
            };
        }
    }
}
