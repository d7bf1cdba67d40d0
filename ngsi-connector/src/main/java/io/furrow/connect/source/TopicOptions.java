package io.furrow.connect.source;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.Width;
import org.apache.kafka.common.config.ConfigException;

import io.furrow.connect.Validators;
import io.furrow.model.topic.Topics;

/** What is written where. */
record TopicOptions(AbstractConfig config) {
    static final String TOPIC = "topic";
    static final String DEAD_LETTER_TOPIC = "dead.letter.topic";

    TopicOptions {
        if (topic(config).equals(deadLetterTopic(config))) {
            throw new ConfigException(DEAD_LETTER_TOPIC, deadLetterTopic(config), "must differ from " + TOPIC);
        }
    }

    static void define(ConfigDef options) {
        String group = "Topics";
        options.define(
                TOPIC,
                Type.STRING,
                Topics.RAW,
                Validators.topic(),
                Importance.HIGH,
                "Topic that every entity of a notification is written to, as normalized NGSI-v2 JSON under its id.",
                group,
                1,
                Width.MEDIUM,
                "Topic");
        options.define(
                DEAD_LETTER_TOPIC,
                Type.STRING,
                "",
                Validators.optionalTopic(),
                Importance.MEDIUM,
                "Topic for what cannot be read, with its original bytes; empty for the topic's name followed by .dead.",
                group,
                2,
                Width.MEDIUM,
                "Dead letters");
    }

    String topic() {
        return topic(config);
    }

    String deadLetterTopic() {
        return deadLetterTopic(config);
    }

    private static String topic(AbstractConfig config) {
        return config.getString(TOPIC);
    }

    private static String deadLetterTopic(AbstractConfig config) {
        String topic = config.getString(DEAD_LETTER_TOPIC);
        return topic.isEmpty() ? Topics.dead(topic(config)) : topic;
    }
}
