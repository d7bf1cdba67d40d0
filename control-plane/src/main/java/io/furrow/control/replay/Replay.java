package io.furrow.control.replay;

import java.util.List;
import java.util.Locale;

import com.fasterxml.jackson.annotation.JsonCreator;
import com.fasterxml.jackson.annotation.JsonValue;
import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.control.manager.StateJson;
import io.furrow.model.control.ReplayCommand;

/**
 * A replay that is wanted: remembered, and a record of {@code service.replays} under its name. Compaction may take away all
 * but the newest record, so it says everything that whoever plays it back has to know.
 *
 * @param replay {@code <mission>.<id8>}
 * @param topic on which it is played
 * @param from event time of the first event, epoch ms; null for the mission's first
 * @param to event time after the last event, epoch ms; null for the mission's end
 * @param speed a number, or {@code max}
 * @param devices ids of the entities that are played back; empty for all
 * @param wanted {@code running}, {@code paused} or {@code stopped}
 * @param seek the newest jump that was asked for; null where none was
 * @param step the newest steps that were asked for; null where none were
 * @param created when, epoch ms
 * @param sequence grows with every change of a replay
 */
public record Replay(
        String replay,
        String mission,
        String topic,
        Long from,
        Long to,
        JsonNode speed,
        boolean loop,
        List<String> devices,
        Wanted wanted,
        Seek seek,
        Step step,
        long created,
        long sequence) {
    /** In which state it shall be. */
    public enum Wanted {
        RUNNING,
        PAUSED,
        STOPPED;

        /** As records have it. */
        @JsonValue
        public String word() {
            return name().toLowerCase(Locale.ROOT);
        }

        @JsonCreator
        static Wanted of(String word) {
            return valueOf(word.toUpperCase(Locale.ROOT));
        }
    }

    /**
     * A jump, which holds for whoever has not yet applied its sequence.
     *
     * @param to event time, epoch ms
     */
    public record Seek(long to, long sequence) {}

    /** @param total events asked for one by one since the replay was started, so that none is lost between two records */
    public record Step(long total, long sequence) {}

    Replay wanted(Wanted next, long newSequence) {
        return new Replay(
                replay, mission, topic, from, to, speed, loop, devices, next, seek, step, created, newSequence);
    }

    Replay at(double newSpeed, long newSequence) {
        JsonNode json = ReplayCommand.json(newSpeed);
        return new Replay(
                replay, mission, topic, from, to, json, loop, devices, wanted, seek, step, created, newSequence);
    }

    Replay jumping(long time, long newSequence) {
        Seek jump = new Seek(time, newSequence);
        return new Replay(
                replay, mission, topic, from, to, speed, loop, devices, wanted, jump, step, created, newSequence);
    }

    Replay stepping(int count, long newSequence) {
        Step steps = new Step((step == null ? 0 : step.total()) + count, newSequence);
        return new Replay(
                replay, mission, topic, from, to, speed, loop, devices, wanted, seek, steps, created, newSequence);
    }

    byte[] toBytes() {
        return StateJson.write(this);
    }
}
