package io.furrow.analytics.collision;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.DataStreamUtils;
import org.apache.flink.streaming.api.datastream.KeyedStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;

import io.furrow.analytics.clock.LaggingPosition;
import io.furrow.analytics.collision.debounce.DebounceEncounters;
import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Pair;
import io.furrow.analytics.collision.encounter.PairObservation;
import io.furrow.analytics.collision.encounter.TrackEncounters;
import io.furrow.analytics.collision.grid.CellUpdate;
import io.furrow.analytics.collision.grid.TrackDevices;
import io.furrow.analytics.collision.matching.CellOverflow;
import io.furrow.analytics.collision.matching.MatchPairs;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.Device;
import io.furrow.analytics.position.PositionFix;

/**
 * Detects encounters among positions, as defined for this package.
 *
 * @param encounters every start and end, and updates between at a limited rate; a pair's in order of time
 * @param late positions that arrived after the watermark and were not counted
 * @param lagging the late positions that are the newest of their device
 * @param overflows cells with more close pairs than the rules allow to follow
 */
public record CollisionDetection(
        DataStream<Encounter> encounters,
        DataStream<PositionFix> late,
        DataStream<LaggingPosition> lagging,
        DataStream<CellOverflow> overflows) {
    /** Detects in event time; {@code fixes} carry timestamps equal to {@link PositionFix#time} and watermarks. */
    public static CollisionDetection define(KeyedStream<PositionFix, Device> fixes, CollisionRules rules) {
        SingleOutputStreamOperator<CellUpdate> updates = fixes.transform(
                        "Track devices through the grid", TypeInformation.of(CellUpdate.class), new TrackDevices(rules))
                .uid("track-devices");

        SingleOutputStreamOperator<PairObservation> observations = updates.keyBy(CellUpdate::cell)
                .transform("Match pairs in each cell", TypeInformation.of(PairObservation.class), new MatchPairs(rules))
                .uid("match-pairs");

        DataStream<Encounter> encounters = observations
                .keyBy(PairObservation::pair)
                .transform(
                        "Track encounters of each pair",
                        TypeInformation.of(Encounter.class),
                        new TrackEncounters(rules))
                .uid("track-encounters");

        DataStream<Encounter> lasting = rules.steadiness().isNone() ? encounters : steady(encounters, rules);

        return new CollisionDetection(
                lasting,
                updates.getSideOutput(TrackDevices.LATE),
                updates.getSideOutput(TrackDevices.LAGGING),
                observations.getSideOutput(MatchPairs.OVERFLOWS));
    }

    /** A pair's records keep their partition: the key is that of the previous stage. */
    private static DataStream<Encounter> steady(DataStream<Encounter> encounters, CollisionRules rules) {
        return DataStreamUtils.reinterpretAsKeyedStream(encounters, Encounter::pair, TypeInformation.of(Pair.class))
                .process(new DebounceEncounters(rules))
                .uid("debounce-encounters")
                .name("Debounce encounters of each pair");
    }
}
