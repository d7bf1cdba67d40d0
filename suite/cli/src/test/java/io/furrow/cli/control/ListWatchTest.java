package io.furrow.cli.control;

import java.util.concurrent.Callable;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;

import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.table.ControlTable;

import static org.assertj.core.api.Assertions.assertThat;

class ListWatchTest {
    @AutoClose
    private final StubControl control = new StubControl();

    @Command(name = "list")
    private static final class ListCommand implements Callable<Integer> {
        @Mixin
        private ControlOptions options;

        @Mixin
        private final ListOptions list = new ListOptions(1);

        @Override
        public Integer call() {
            return list.show(
                    options,
                    "/api/list",
                    new ControlTable("none")
                            .text("NAME", "/name")
                            .text("STATE", "/state")
                            .age("AGE", "/since"));
        }
    }

    @Test
    void printsWhatIsNewOrHasChanged() {
        control.answer("GET /api/list", "[{'name':'a','state':'off','since':0},{'name':'b','state':'on','since':0}]")
                .answer("GET /api/list", "[{'name':'a','state':'off','since':9},{'name':'b','state':'off','since':0}]")
                .answer("GET /api/list", "[{'name':'a','state':'off','since':0},{'name':'b','state':'off','since':0}]")
                .answer("GET /api/list", "[{'name':'long-name','state':'on'},{'name':'a','state':'off'}]")
                .answer("GET /api/list", 409, "{'error':'over','reason':'it ends'}");

        assertThat(run("--watch")).isEqualTo(1);

        assertThat(control.output().lines().map(line -> line.replaceAll("[0-9]+d", "days")))
                .containsExactly(
                        "NAME  STATE  AGE",
                        "a     off    days",
                        "b     on     days",
                        "b     off    days",
                        "long-name  on     -",
                        "it ends (over)");
    }

    @Test
    void printsNamesOfWhatIsNewAndEndsWithoutTheOption() {
        control.answer("GET /api/list", "[{'name':'a'}]")
                .answer("GET /api/list", "[{'name':'a'},{'name':'b'}]")
                .answer("GET /api/list", 409, "{'error':'over','reason':'it ends'}");

        run("-w", "-o", "name");
        assertThat(control.output().lines()).containsExactly("a", "b", "it ends (over)");

        control.answer("GET /api/list", "[]");
        run();
        control.output();
        assertThat(run()).isZero();
        assertThat(control.output()).isEqualToIgnoringNewLines("none");
    }

    @Test
    void readsAListByPagesUpToItsLimit() {
        control.answerPage("GET /api/list", "[{'name':'a'},{'name':'b'}]", "?limit=1000&page=2")
                .answer("GET /api/list?limit=1000&page=2", "[{'name':'c'}]")
                .answerPage("GET /api/list?limit=2", "[{'name':'a'},{'name':'b'}]", "?limit=2&page=2");

        assertThat(run("-o", "name")).isZero();
        assertThat(control.output().lines()).containsExactly("a", "b", "c");
        assertThat(run("-n", "2", "-o", "name")).isZero();
        assertThat(control.output().lines())
                .containsExactly("a", "b", "There are more than 2; --limit shows more of them.");
        assertThat(run("--limit", "0")).isEqualTo(2);
        assertThat(control.output()).contains("--limit is 1 to 20000, not 0");
    }

    @Test
    void printsValuesByJsonPath() {
        control.answer("GET /api/v1/list", "[{'name':'a','at':'2026-11-27T05:00:00Z'},{'name':'b','at':null}]");

        assertThat(run("-o", "jsonpath={.items[*].name}")).isZero();
        assertThat(run("-o", "jsonpath={range .items[*]}{.name} {.at}{\"\\n\"}{end}"))
                .isZero();
        assertThat(control.output().lines()).containsExactly("a b", "a 2026-11-27T05:00:00Z", "b null");

        control.answer("GET /api/missions/typo", 404, "{'error':'unknown','reason':'there is none'}");
        control.run("mission", "show", "typo", "-o", "jsonpath={.status.state}");
        assertThat(control.output()).isEqualToIgnoringNewLines("there is none (unknown)");
        assertThat(control.run("mission", "list", "-o", "jsonpath={.items[}")).isEqualTo(2);
        assertThat(control.output()).contains("'--output': '.items[' is no JSONPath: cannot be read at character 7");
        assertThat(control.run("mission", "list", "-o", "jsn")).isEqualTo(2);
        assertThat(control.output()).contains("expected one of [table, wide, json, yaml, name, jsonpath=, csv, env]");
    }

    /** Otherwise a misspelled name looks like a mission without devices. */
    @ParameterizedTest
    @CsvSource({
        "device list --mission=typo, /api/devices?mission=typo, /api/missions/typo",
        "device list --domain=typo, /api/devices?domain=typo, /api/domains/typo",
        "mission list --domain=typo, /api/missions?domain=typo, /api/domains/typo"
    })
    void rejectsWhatSelectsNothingBecauseItDoesNotExist(String command, String list, String selector) {
        control.answer("GET " + list, "[]");

        assertThat(control.run(command.split(" "))).isEqualTo(1);
        assertThat(control.output()).isEqualToIgnoringNewLines("there is no GET %s (unknown)".formatted(selector));

        control.answer("GET " + selector, "{}");
        assertThat(control.run(command.split(" "))).isZero();
        assertThat(control.output()).startsWith("There ");
    }

    private int run(String... arguments) {
        return control.run(new CommandLine(new ListCommand()), arguments);
    }
}
