package io.furrow.flink;

import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.streaming.api.functions.sink.v2.DiscardingSink;
import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class JobUidsTest {
    private final StreamExecutionEnvironment env = StreamExecutionEnvironment.getExecutionEnvironment();
    private final DataStream<Long> numbers = env.fromSequence(1, 3).uid("numbers");

    @Test
    void listsTheUidsOfTheStreamGraph() {
        numbers.sinkTo(new DiscardingSink<>()).uid("discard");

        assertThat(JobUids.of(env)).containsExactly("discard", "numbers");
        assertThat(JobUids.of(env)).as("and again").containsExactly("discard", "numbers");
    }

    @Test
    void namesAnOperatorWithoutAUid() {
        numbers.sinkTo(new DiscardingSink<>()).name("Forgotten sink");

        assertThatThrownBy(() -> JobUids.of(env))
                .isInstanceOf(AssertionError.class)
                .hasMessageContaining("Forgotten sink");
    }

    @Test
    void namesAListThatIsMissing() {
        assertThatThrownBy(() -> JobUids.checkedIn("no-such-job"))
                .isInstanceOf(AssertionError.class)
                .hasMessageContaining("src/test/resources/uids/no-such-job.txt");
    }
}
