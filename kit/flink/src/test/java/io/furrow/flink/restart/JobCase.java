package io.furrow.flink.restart;

import java.util.ArrayList;
import java.util.List;
import java.util.Set;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.job.JobOptions;
import io.furrow.flink.record.TopicRecord;

/** A job over a random input, for {@link Restarts}. */
public abstract class JobCase {
    /** In the order of arrival. */
    protected final List<Arrival> arrivals = new ArrayList<>();

    /** How much later than a newer record an older one may come, ms. */
    public abstract long bound();

    /** With {@code --parallelism}. */
    public abstract JobOptions options(int parallelism);

    /** The pipeline of these options; every operator has a uid. */
    public abstract DataStream<TopicRecord> define(
            StreamExecutionEnvironment env, DataStream<TopicRecord> records, JobOptions options) throws Exception;

    /** To which an undisturbed run must write, else it shows little. */
    public abstract Set<String> topics();

    /** Names of the operators that treat what is late in another way. */
    public abstract List<String> judges();

    /** Of records with the same identity the last counts; by default only equal ones have it. */
    public String identity(TopicRecord record) {
        return content(record);
    }

    /** What a record says; nothing that differs from run to run. */
    public String content(TopicRecord record) {
        return Restarts.text(record);
    }

    /**
     * A record that arrives.
     *
     * @param afterAll whether it arrives only when all judges have the watermark of the records before it; else which of them
     *     has it already depends on chance
     */
    public record Arrival(TopicRecord record, boolean afterAll) {}
}
