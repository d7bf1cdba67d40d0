package io.furrow.cli.control;

import java.util.concurrent.Callable;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;

import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.table.RecordPage;

import static org.assertj.core.api.Assertions.assertThat;

class TopicCommandGroupTest {
    private static final String RAW = "GET /api/v1/topics/data.raw/records?values=true&limit=";

    @AutoClose
    private final StubControl control = new StubControl();

    @Command(name = "tail")
    private static final class TailCommand implements Callable<Integer> {
        @Mixin
        private ControlOptions options;

        @Mixin
        private final RecordTail tail = new RecordTail(1);

        @Override
        public Integer call() {
            return tail.print(options, "data.raw", "k", RecordPage::line);
        }
    }

    @Test
    void listsTopicsAndShowsARecord() {
        control.answer("GET /api/v1/topics", "[{'topic':'data.raw','partitions':4,'records':12}]")
                .answer("GET /api/v1/topics/data.a-b/records/3/17", """
                        {'topic':'data.a-b','partition':3,'offset':17,'time':'2026-11-27T05:00:00Z','key':'k','size':3,'headers':{'ts-source':'1'},
                         'encoding':'text','value':'wet','cut':false}""");

        control.run("topic", "list");
        assertThat(control.output()).contains("TOPIC", "data.raw  4           12");

        assertThat(control.run("topic", "show", "data.a-b-3@17")).isZero();
        assertThat(control.output().lines())
                .containsExactly(
                        "record   data.a-b-3@17",
                        "time     2026-11-27T05:00:00Z",
                        "key      k",
                        "size     3",
                        "headers",
                        "  ts-source: 1",
                        "value, as text",
                        "wet");
        assertThat(control.run("topic", "show", "data.raw")).isEqualTo(2);
        assertThat(control.output()).contains("write <topic>-<partition>@<offset>");
    }

    @Test
    void printsTheNewestRecordsInOrder() {
        control.answer(RAW + "2&key=k", "[" + recordAt(0, 7, "k", "{'n':2}") + "," + recordAt(1, 9, "k", "null") + "]");

        assertThat(control.run("topic", "tail", "data.raw", "-n", "2", "--key", "k"))
                .isZero();

        assertThat(control.output().lines())
                .containsExactly(
                        "data.raw-1@9  2026-11-27T05:00:00Z  k  -", "data.raw-0@7  2026-11-27T05:00:00Z  k  {\"n\":2}");
        assertThat(control.run("topic", "tail", "data.raw", "-n", "0")).isEqualTo(2);
    }

    @Test
    void followsATopicFromWhatItHasPrinted() {
        String known = recordAt(0, 5, "k", "1");
        String old = recordAt(1, 3, "k", "0");
        control.answer(RAW + "20&key=k", "[" + known + "]")
                .answer(RAW + "100", "[" + known + "," + old + "]")
                .answer(RAW + "100", "[" + recordAt(0, 6, "other", "2") + "," + known + "," + old + "]")
                .answer(RAW + "100", "[" + recordAt(0, 7, "k", "3") + "," + recordAt(0, 6, "other", "2") + "]")
                .answer(RAW + "100", "[" + recordAt(1, 4, "k", "4") + "," + recordAt(0, 7, "k", "3") + "]")
                .answer(RAW + "100", 409, "{'error':'over','reason':'it ends'}");

        assertThat(control.run(new CommandLine(new TailCommand()), "-f")).isEqualTo(1);

        assertThat(control.output().lines().map(line -> line.replaceAll(" +\\S+Z +", " ")))
                .containsExactly("data.raw-0@5 k  1", "data.raw-0@7 k  3", "data.raw-1@4 k  4", "it ends (over)");
    }

    @Test
    void printsReportsOfADevice() {
        control.answer(RAW + "1&key=urn%3Aa", """
                [{'topic':'data.raw','partition':0,'offset':1,'time':'2026-11-27T05:00:00Z','key':'urn:a','headers':{'fiware-service':'farm'},
                  'value':{'id':'urn:a','type':'Pump','wet':{'type':'Boolean','value':true},'place':{'value':{'lat':1}}}}]""");

        assertThat(control.run("device", "tail", "urn:a", "-n", "1")).isZero();

        assertThat(control.output())
                .isEqualToIgnoringNewLines("2026-11-27T05:00:00Z  service=farm  wet=true  place={\"lat\":1}");
    }

    @Test
    void findsRecordsInAllTopicsOfData() {
        String from = "&from=2026-11-27T00%3A00%3A00Z";
        control.answer("GET /api/v1/topics", """
                        [{'topic':'data.raw'},{'topic':'data.raw.dead'},{'topic':'data.m.replay.0a1b2c3d.collision'},{'topic':'service.missions'}]""")
                .answer(
                        "GET /api/v1/topics/data.raw/records?limit=20&text=urn%3Aa" + from,
                        "[" + recordAt(0, 7, "k", "null") + "]")
                .answer(
                        RAW + "100&text=urn%3Aa" + from,
                        "[" + recordAt(0, 8, "k", "{'n':1}") + "," + recordAt(0, 7, "k", "{'wet':1}") + "]");

        assertThat(control.run("topic", "find", "--device", "urn:a", "--since", "2026-11-27"))
                .isZero();
        assertThat(control.output()).containsPattern("data.raw-0@7 +2026-11-27T05:00:00Z +k +3");
        assertThat(control.requested()).hasSize(2);

        control.run("topic", "find", "data.raw", "--device", "urn:a", "--attribute", "wet", "--since", "2026-11-27");
        assertThat(control.output()).contains("data.raw-0@7").doesNotContain("data.raw-0@8");
        assertThat(control.run("topic", "find", "data.raw")).isEqualTo(2);
        assertThat(control.output()).contains("Name a device with --device, or a text with --text.");
    }

    @Test
    void asksForRecordsAndDeadLettersOfATime() {
        control.run("topic", "find", "data.raw", "--text", "x");
        control.run("topic", "find", "data.raw", "--text", "x", "--to", "2026-11-27");
        control.run("dead-letters", "list", "--since", "2026-11-26", "--to", "2026-11-27");

        assertThat(control.requested())
                .satisfiesExactly(
                        hour -> assertThat(hour).matches("GET .*/records\\?limit=20&text=x&from=20\\S+Z"),
                        to -> assertThat(to).endsWith("/records?limit=20&text=x&to=2026-11-27T00%3A00%3A00Z"),
                        letters -> assertThat(letters)
                                .endsWith("?limit=50&from=2026-11-26T00%3A00%3A00Z&to=2026-11-27T00%3A00%3A00Z"));
    }

    private static String recordAt(int partition, long offset, String key, String value) {
        return "{'topic':'data.raw','partition':%d,'offset':%d,'time':'2026-11-27T05:00:00Z','key':'%s','size':3,'value':%s}"
                .formatted(partition, offset, key, value);
    }
}
