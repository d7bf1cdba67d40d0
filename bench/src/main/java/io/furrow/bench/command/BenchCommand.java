package io.furrow.bench.command;

import java.time.Duration;

import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;

import io.furrow.bench.analytics.AnalyticsBench;
import io.furrow.bench.component.CompareBench;
import io.furrow.bench.component.ComponentsBench;
import io.furrow.bench.control.ControlBench;
import io.furrow.bench.evaluation.EvaluateBench;
import io.furrow.bench.fleet.FleetBench;
import io.furrow.bench.image.ImageBench;
import io.furrow.bench.ingest.IngestBench;
import io.furrow.bench.load.LoadBench;
import io.furrow.bench.load.OverloadBench;
import io.furrow.bench.mission.MissionBench;
import io.furrow.bench.mongo.MongoBench;
import io.furrow.bench.notifications.NotificationBench;
import io.furrow.bench.replay.ReplayBench;
import io.furrow.bench.sink.SinkBench;
import io.furrow.bench.whole.WholeBench;
import io.furrow.cli.option.HelpOption;
import io.furrow.flink.job.Delivery;
import io.furrow.flink.job.DurationConverter;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.launcher.Furrow;

/** {@code ./furrow bench}. */
@Command(
        name = "bench",
        description = "Measures the suite on this machine.",
        synopsisSubcommandLabel = "COMMAND",
        subcommands = {
            NotificationBench.class,
            SinkBench.class,
            ImageBench.class,
            IngestBench.class,
            AnalyticsBench.class,
            ReplayBench.class,
            ControlBench.class,
            FleetBench.class,
            MissionBench.class,
            WholeBench.class,
            EvaluateBench.class,
            ComponentsBench.class,
            DashboardBench.class,
            CompareBench.class,
            LoadBench.class,
            MongoBench.class,
            OverloadBench.class
        })
public final class BenchCommand {
    @Mixin
    private HelpOption help;

    public static void main(String... args) {
        System.setProperty("java.awt.headless", "true");
        System.exit(commandLine().execute(args));
    }

    static CommandLine commandLine() {
        return Furrow.commandLine()
                .addSubcommand(new BenchCommand())
                .registerConverter(Duration.class, new DurationConverter())
                .registerConverter(Delivery.class, JobCommandLine::delivery);
    }
}
