package io.furrow.bench.command;

import java.util.concurrent.Callable;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;

import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.HelpOption;

/** {@code ./furrow bench dashboard}, which the script runs itself: the class path of this command has no driver of a browser. */
@Command(
        name = "dashboard",
        abbreviateSynopsis = true,
        description = {
            "Measures the page in the machine's Chromium: from an event in Kafka to its pixel and to its card; the main thread's time for a frame"
                    + " of 1,000 moving devices, of the map alone and with cards in view, beside a bare page of OpenLayers; then 200 sockets of which"
                    + " 20 are slow.",
            "Its parts have options: ./furrow soak page --help and ./furrow soak dashboard-sockets --help."
        })
final class DashboardBench implements Callable<Integer> {
    @Mixin
    private HelpOption help;

    @Override
    public Integer call() {
        throw new CommandException("The script furrow runs this, as './furrow bench dashboard'.");
    }
}
