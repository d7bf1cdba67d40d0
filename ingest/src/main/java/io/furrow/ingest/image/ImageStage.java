package io.furrow.ingest.image;

import java.io.IOException;
import java.util.Optional;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.streaming.api.datastream.KeyedStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;
import org.apache.flink.streaming.api.operators.AbstractStreamOperatorFactory;
import org.apache.flink.streaming.api.operators.OneInputStreamOperatorFactory;
import org.apache.flink.streaming.api.operators.StreamOperator;
import org.apache.flink.streaming.api.operators.StreamOperatorParameters;
import org.apache.flink.util.OutputTag;

import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.text.FailureText;

/**
 * The stage of a job that moves images: events are emitted once, in order per entity. Broken images go to
 * {@link DeadLetters#TAG}. Without {@code --images} all events pass unchanged, so that the job graph stays the same.
 */
public final class ImageStage {
    /** A record for {@code data.images} for each stored image. */
    public static final OutputTag<TopicRecord> MANIFEST = new OutputTag<>("image-manifest") {
        private static final long serialVersionUID = 1L;
    };

    private ImageStage() {}

    /** @param events by {@link CarriesImages#identity()}; the caller gives uid and name */
    public static SingleOutputStreamOperator<ReportedEvent> move(
            KeyedStream<ReportedEvent, String> events, ImageOptions options, StorageMode storageMode) {
        Optional<ImageSettings> settings = options.settings(storageMode);
        settings.ifPresent(given -> check(given, options));
        return events.transform("move-images", events.getType(), operator(settings.orElse(null), events.getType()));
    }

    /** @param settings null if images stay in the events */
    static OneInputStreamOperatorFactory<ReportedEvent, ReportedEvent> operator(
            ImageSettings settings, TypeInformation<ReportedEvent> type) {
        return new Factory(settings, type);
    }

    /** Checks early, when an invalid setting can be rejected, rather than when the job runs. */
    private static void check(ImageSettings settings, ImageOptions options) {
        try {
            ImageStore.of(settings);
        } catch (IOException e) {
            throw options.refused(
                    "--images " + settings.root() + ": Flink has no file system for it here (" + FailureText.of(e)
                            + ")",
                    e);
        }
    }

    private static final class Factory extends AbstractStreamOperatorFactory<ReportedEvent>
            implements OneInputStreamOperatorFactory<ReportedEvent, ReportedEvent> {
        private static final long serialVersionUID = 1L;

        private final ImageSettings settings;
        private final TypeInformation<ReportedEvent> type;

        Factory(ImageSettings settings, TypeInformation<ReportedEvent> type) {
            this.settings = settings;
            this.type = type;
        }

        @Override
        @SuppressWarnings("unchecked") // the caller names the operator's type, which is ours
        public <T extends StreamOperator<ReportedEvent>> T createStreamOperator(
                StreamOperatorParameters<ReportedEvent> parameters) {
            return (T) new MoveImages(parameters, settings, type, parameters.getMailboxExecutor());
        }

        @Override
        @SuppressWarnings("rawtypes") // required by the interface
        public Class<? extends StreamOperator> getStreamOperatorClass(ClassLoader loader) {
            return MoveImages.class;
        }
    }
}
