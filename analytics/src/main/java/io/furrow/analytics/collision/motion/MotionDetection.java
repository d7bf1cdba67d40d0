package io.furrow.analytics.collision.motion;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;

import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.time.KeyedLatenessOperator;

/** Detects predictions and crossings among positions, as defined for this package, in addition to encounters. */
public final class MotionDetection {
    private MotionDetection() {}

    /** Detects in event time; {@code fixes} carry timestamps equal to {@link PositionFix#time} and watermarks. */
    public static DataStream<Approach> define(DataStream<PositionFix> fixes, MotionRules rules) {
        SingleOutputStreamOperator<SegmentUpdate> segments = fixes.filter(fix -> rules.moves(fix.type()))
                .uid("select-moving-types")
                .name("Select moving types")
                .keyBy(PositionFix::key)
                .transform(
                        "Track the motion of devices",
                        TypeInformation.of(SegmentUpdate.class),
                        new KeyedLatenessOperator<>(new TrackMotion(rules)))
                .uid("track-motion");

        SingleOutputStreamOperator<ApproachCandidate> predictions = segments.keyBy(SegmentUpdate::cube)
                .process(new MatchSegments(rules))
                .uid("match-segments")
                .name("Match segments in each cube");

        DataStream<Approach> predicted = predictions
                .keyBy(ApproachCandidate::pair)
                .process(new TrackPredictions(rules))
                .uid("track-predictions")
                .name("Track predictions of each pair");

        DataStream<Approach> crossed = predictions
                .getSideOutput(MatchSegments.CONTACTS)
                .keyBy(ApproachCandidate::pair)
                .process(new JoinContacts(rules))
                .uid("join-contacts")
                .name("Join contacts between reports");

        return predicted.union(crossed);
    }
}
