package io.furrow.flink.job;

import java.util.List;

import picocli.CommandLine.IModelTransformer;
import picocli.CommandLine.Model.CommandSpec;

/** Removes the options of event time from those of a job without it. Holds no Flink type, like {@link JobOptions}. */
public final class WithoutEventTime implements IModelTransformer {
    private static final List<String> OPTIONS = List.of(
            "--out-of-orderness", "--idle-timeout", "--idle-advance", "--clock-skew", "--max-ahead", "--max-behind");

    @Override
    public CommandSpec transform(CommandSpec spec) {
        OPTIONS.forEach(name -> spec.remove(spec.findOption(name)));
        return spec;
    }
}
