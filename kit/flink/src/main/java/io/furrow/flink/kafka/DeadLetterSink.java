package io.furrow.flink.kafka;

import java.io.IOException;

import org.apache.flink.api.connector.sink2.Sink;
import org.apache.flink.api.connector.sink2.SinkWriter;
import org.apache.flink.api.connector.sink2.WriterInitContext;

import io.furrow.flink.job.JobOptions;
import io.furrow.flink.record.TopicRecord;

/**
 * A sink for the dead letters of another sink, whose writer opens and flushes a writer of this one. It takes no part in
 * transactions: after a failure a letter may be duplicated. Topics are created, and letters truncated, as by
 * {@link EnsureTopics}.
 */
public final class DeadLetterSink implements Sink<TopicRecord> {
    private static final long serialVersionUID = 1L;

    private final EnsureTopics topics;
    private final Sink<TopicRecord> kafka;

    public DeadLetterSink(JobOptions options, TopicOptions.Settings settings) {
        this.topics = new EnsureTopics(options, settings);
        this.kafka = KafkaConnectors.atLeastOnceSink(options);
    }

    @Override
    public SinkWriter<TopicRecord> createWriter(WriterInitContext context) throws IOException {
        return new Writer(kafka.createWriter(context), topics.writable());
    }

    @SuppressWarnings("try") // close() may be interrupted, as a sink writer's may
    private record Writer(SinkWriter<TopicRecord> kafka, LimitRecordSize writable) implements SinkWriter<TopicRecord> {
        @Override
        public void write(TopicRecord letter, Context context) throws IOException, InterruptedException {
            kafka.write(writable.of(letter), context);
        }

        @Override
        public void flush(boolean endOfInput) throws IOException, InterruptedException {
            kafka.flush(endOfInput);
        }

        @Override
        public void close() throws Exception {
            try {
                kafka.close();
            } finally {
                writable.close();
            }
        }
    }
}
