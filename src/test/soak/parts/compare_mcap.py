"""Compares MCAP files with the lines beside them: compare_mcap.py FILE.mcap FILE.ndjson …"""
import json
import sys
from decimal import Decimal

from mcap.reader import NonSeekingReader, SeekingReader

LAST = (2**64 - 1) // 1_000_000


def exact(text):
    return json.loads(text, parse_float=Decimal)


def expected(path):
    types = {}
    for line in open(path, encoding="utf-8"):
        event = exact(line)
        if not 0 <= event["time"] <= LAST:
            continue
        entity = event["entity"]
        service = event["headers"].get("fiware-service", "")
        entity_id = entity["id"] if entity else event["entityId"]
        known = types.get((service, entity_id), "Thing")
        types[service, entity_id] = kind = entity.get("type", "Thing") if entity else known
        data = entity or {"id": entity_id, "deleted": True}
        yield f"{kind}/{entity_id}", event["time"] * 1_000_000, service, data


def read(reader, **span):
    for schema, channel, message in reader.iter_messages(**span):
        assert schema.encoding == "jsonschema" and schema.name == channel.topic.split("/")[0], schema
        assert json.loads(schema.data)["type"] == "object"
        assert channel.message_encoding == "json" and message.publish_time == message.log_time
        yield channel.topic, message.log_time, channel.metadata["fiware-service"], exact(message.data)


def order(message):
    return message[1], message[2], message[0], json.dumps(message[3], default=str)


def compare(mcap, lines):
    wanted = sorted(expected(lines), key=order)
    with open(mcap, "rb") as file:
        straight = sorted(read(NonSeekingReader(file, validate_crcs=True)), key=order)
    assert straight == wanted, f"{mcap}: read from start to end"
    with open(mcap, "rb") as file:
        reader = SeekingReader(file, validate_crcs=True)
        summary = reader.get_summary()
        assert summary.statistics.message_count == len(wanted)
        assert sum(summary.statistics.channel_message_counts.values()) == len(wanted)
        assert sorted(read(reader), key=order) == wanted, f"{mcap}: read by its index"
        if wanted:
            middle = wanted[len(wanted) // 2][1]
            late = [message for message in wanted if message[1] >= middle]
            assert sorted(read(reader, starting_at=middle), key=order) == late, f"{mcap}: from the middle"
            topic = wanted[0][0]
            of_topic = [message for message in wanted if message[0] == topic]
            assert sorted(read(reader, topics=[topic]), key=order) == of_topic, f"{mcap}: one topic"
    print(f"{mcap}: {len(wanted)} events, {len(summary.channels)} channels, {len(summary.chunk_indexes)} chunks")


for i in range(1, len(sys.argv), 2):
    compare(sys.argv[i], sys.argv[i + 1])
