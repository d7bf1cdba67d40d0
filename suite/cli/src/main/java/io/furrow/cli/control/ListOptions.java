package io.furrow.cli.control;

import java.util.stream.Stream;

import picocli.CommandLine.Mixin;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.client.ListLimit;
import io.furrow.cli.control.table.ControlTable;

/** The options of lists of what there is, which are read by pages. */
final class ListOptions extends ListWatch {
    @Mixin
    private final ListLimit limit = new ListLimit();

    ListOptions() {}

    /** @param pollMillis time between two requests of {@code --watch} */
    ListOptions(long pollMillis) {
        super(pollMillis);
    }

    /** Prints the list at a path as a table. @param selectors paths of what selects its rows, which must exist */
    int show(ControlOptions control, String path, ControlTable table, String... selectors) {
        limit.check(control);
        return control.run(api -> {
            ControlApi.Page listed = limit.read(api, path);
            if (listed.elements().isEmpty()) {
                Stream.of(selectors).forEach(api::get);
            }
            control.print(listed.elements(), table);
            limit.remark(control, listed);
            follow(control, listed.elements(), () -> limit.read(api, path).elements(), table);
        });
    }
}
