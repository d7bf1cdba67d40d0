package io.furrow.analytics.temperature;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.datastream.KeyedStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;
import org.apache.flink.util.OutputTag;

import io.furrow.flink.record.TopicRecord;

/** The window stages: first each device votes in each field, then the votes of a field are averaged. */
final class VoteStage {
    static final OutputTag<FieldReading> LATE = new OutputTag<>("late-readings") {
        private static final long serialVersionUID = 1L;
    };

    private VoteStage() {}

    static SingleOutputStreamOperator<DeviceVote> cast(DataStream<FieldReading> readings, TemperatureOptions options) {
        KeyedStream<FieldReading, String> byVoter = readings.keyBy(FieldReading::voter);
        return byVoter.transform(
                        "Cast one vote per device",
                        TypeInformation.of(DeviceVote.class),
                        new CastVotes(
                                EpochWindows.of(options.window(), options.slide()),
                                options.allowedLateness(),
                                LATE,
                                byVoter))
                .uid("cast-votes");
    }

    /** A vote has the timestamp of its window's last instant, so that windows of one slide regroup each window's votes. */
    static SingleOutputStreamOperator<FieldAverage> average(DataStream<DeviceVote> votes, TemperatureOptions options) {
        return votes.keyBy(DeviceVote::fieldIdentity)
                .window(EpochWindows.of(options.slide(), options.slide()))
                .allowedLateness(options.allowedLateness())
                .process(new AverageVotes(options.suspectFloor()))
                .uid("average-votes")
                .name("Average the votes of each field");
    }

    static DataStream<TopicRecord> late(SingleOutputStreamOperator<DeviceVote> votes, TemperatureOptions options) {
        return votes.getSideOutput(LATE)
                .map(new TagLateReading(options.lateOutput(), options.window(), options.slide()))
                .uid("name-late-window")
                .name("Name the window of late readings");
    }
}
