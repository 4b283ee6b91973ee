"""JSON Schemas of all JSON that disting writes, a file each."""

from disting.files import Format as Format, schema as schema
