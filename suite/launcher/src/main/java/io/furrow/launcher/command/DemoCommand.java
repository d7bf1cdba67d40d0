package io.furrow.launcher.command;

import java.util.concurrent.Callable;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Spec;

import io.furrow.cli.option.HelpOption;
import io.furrow.launcher.option.SuiteOptions;

/** {@code ./furrow demo}. */
@Command(
        name = "demo",
        abbreviateSynopsis = true,
        description =
                "Starts everything in one JVM on 127.0.0.1 with the missions and simulated devices of a small farm, "
                        + "and shows the results.")
public final class DemoCommand implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

    @Mixin
    private SuiteOptions options;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() throws Exception {
        return new Session(spec.commandLine().getOut()).run(options.demonstration(), options.data, suite -> {
            DemoFarm.start(suite.control());
            return () -> {};
        });
    }
}
