package io.furrow.bench.replay;

import java.time.Instant;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.locks.LockSupport;

import org.apache.kafka.clients.producer.ProducerRecord;

import io.furrow.bench.frame.TopicFiller;
import io.furrow.mission.StoredEvent;
import io.furrow.replay.record.EventEncoder;

/** Writes the events of replays when they are due, with one thread and one producer that sleep until the next. */
final class BaselineSchedule {
    private final List<Turn> turns = new ArrayList<>();

    private record Turn(long due, ScheduledReplay replay, EventEncoder encoder, StoredEvent event, long sequence) {
        ProducerRecord<byte[], byte[]> record(long now) {
            return PlayedRecord.written(event, replay.replay(), encoder, sequence, now);
        }
    }

    /** @param until event time up to which everything is written, exclusive, epoch ms */
    BaselineSchedule(List<ScheduledReplay> replays, long until) {
        Map<StoredMission, List<StoredEvent>> events = new HashMap<>();
        for (ScheduledReplay replay : replays) {
            long sequence = 0;
            EventEncoder encoder = PlayedRecord.encoder(replay.replay());
            for (StoredEvent event : events.computeIfAbsent(replay.mission(), StoredMission::all)) {
                if (event.time() < until) {
                    turns.add(new Turn(replay.due(event.time()), replay, encoder, event, sequence++));
                }
            }
        }
        turns.sort(Comparator.comparingLong(Turn::due));
    }

    void write(TopicFiller producer) {
        for (Turn turn : turns) {
            long wait = TimeUnit.MILLISECONDS.toNanos(turn.due()) - epochNanos();
            while (wait > 0) {
                LockSupport.parkNanos(wait);
                wait = TimeUnit.MILLISECONDS.toNanos(turn.due()) - epochNanos();
            }
            producer.send(turn.record(System.currentTimeMillis()));
        }
        producer.flush();
    }

    private static long epochNanos() {
        Instant now = Instant.now();
        return TimeUnit.SECONDS.toNanos(now.getEpochSecond()) + now.getNano();
    }
}
