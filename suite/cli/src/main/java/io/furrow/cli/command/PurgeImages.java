package io.furrow.cli.command;

import java.io.FileNotFoundException;
import java.io.IOException;
import java.io.PrintWriter;
import java.time.DateTimeException;
import java.time.Duration;
import java.time.Instant;
import java.util.concurrent.Callable;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import org.apache.flink.core.fs.FileStatus;
import org.apache.flink.core.fs.FileSystem;
import org.apache.flink.core.fs.Path;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

import io.furrow.cli.option.Confirmation;
import io.furrow.cli.option.HelpOption;
import io.furrow.flink.job.FileSystemOptions;
import io.furrow.mission.image.ImageName;
import io.furrow.model.text.Counts;
import io.furrow.model.text.FailureText;

/** Deletes images whose event time, by their file name, is older than allowed; other files are left alone. */
@Command(
        name = "purge",
        abbreviateSynopsis = true,
        description = "Deletes images beyond an age, by the event time in their names, and incomplete files of killed "
                + "writers. Other files stay.")
final class PurgeImages implements Callable<Integer> {
    private static final Pattern IMAGE = Pattern.compile(".+_(\\d{17})(-[0-9a-f]{64})?\\.(png|jpg)");
    /** Longer than any write takes. */
    private static final Duration UNFINISHED_AGE = Duration.ofHours(1);

    @Spec
    private CommandSpec spec;

    @Parameters(paramLabel = "URI", description = "The folder of the job's option --images, or one below it.")
    private String root;

    @Option(
            names = "--older-than",
            paramLabel = "DURATION",
            required = true,
            description = "Delete older images, for instance 30d.")
    private Duration age;

    @Mixin
    private final FileSystemOptions fileSystems = new FileSystemOptions();

    @Option(names = "--dry-run", description = "Show what would be deleted and delete nothing.")
    private boolean dryRun;

    @Mixin
    private Confirmation confirmation;

    @Mixin
    private HelpOption help;

    private Instant now;
    private FileSystem files;
    private long deleted;
    private long deletedBytes;
    private long retained;

    @Override
    public Integer call() throws IOException {
        if (age.isNegative() || age.isZero()) {
            throw new ParameterException(spec.commandLine(), "--older-than must be positive; write for instance 30d");
        }
        fileSystems.initialize();
        now = Instant.now();
        Path folder = new Path(root);
        try {
            files = folder.getFileSystem();
            files.getFileStatus(folder); // a listing would not show that the folder is missing
            if (!dryRun) {
                confirmation.ask("Delete the images in %s from before %s?".formatted(root, now.minus(age)));
            }
            purge(folder);
        } catch (FileNotFoundException e) {
            throw new ParameterException(spec.commandLine(), root + " is not there; name the folder of --images", e);
        } catch (IOException e) {
            throw new ParameterException(spec.commandLine(), root + " cannot be read: " + FailureText.of(e), e);
        }
        PrintWriter out = spec.commandLine().getOut();
        out.printf(
                "%s %s, %d bytes; kept %d.%n",
                dryRun ? "Would delete" : "Deleted", Counts.of(deleted, "file"), deletedBytes, retained);
        out.flush();
        return 0;
    }

    /** Whether the folder is empty afterwards. */
    private boolean purge(Path folder) throws IOException {
        boolean empty = true;
        FileStatus[] found = files.listStatus(folder);
        for (FileStatus one : found == null ? new FileStatus[0] : found) { // null: gone meanwhile
            if (one.isDir()) {
                boolean overdue = purge(one.getPath()) && !dryRun && files.delete(one.getPath(), false);
                empty &= overdue;
            } else if (isOld(one)) {
                deleted++;
                deletedBytes += one.getLen();
                empty &= !dryRun && files.delete(one.getPath(), false);
            } else {
                retained++;
                empty = false;
            }
        }
        return empty;
    }

    private boolean isOld(FileStatus file) {
        String name = file.getPath().getName();
        if (name.startsWith(ImageName.UNFINISHED)) {
            return Instant.ofEpochMilli(file.getModificationTime()).isBefore(now.minus(UNFINISHED_AGE));
        }
        Matcher image = IMAGE.matcher(name);
        try {
            return image.matches() && ImageName.time(image.group(1)).isBefore(now.minus(age));
        } catch (DateTimeException e) {
            return false; // digits that are not a time: another file
        }
    }
}
