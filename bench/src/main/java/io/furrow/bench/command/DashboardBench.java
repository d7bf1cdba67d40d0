package io.furrow.bench.command;

import picocli.CommandLine.Command;

import io.furrow.bench.frame.Benchmark;
import io.furrow.cli.option.CommandException;

/** {@code ./furrow bench dashboard}, which the script runs itself: this command's class path has no browser driver. */
@Command(
        name = "dashboard",
        description = {
            "Measures the page in the machine's Chromium: from an event in Kafka to its pixel and to its card; the main thread's time for a frame"
                    + " of 1,000 moving devices, of the map alone and with cards in view, beside a bare page of OpenLayers; then 200 sockets of which"
                    + " 20 are slow.",
            "Its parts have options: ./furrow soak page --help and ./furrow soak dashboard-sockets --help."
        })
final class DashboardBench extends Benchmark {
    @Override
    public Integer call() {
        throw new CommandException("The script furrow runs this, as './furrow bench dashboard'.");
    }
}
