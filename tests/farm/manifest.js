// manifest.js FILE...: each document of each file by the schema that Kubernetes publishes of its kind (the package
// kubernetes-models is made from the API's own description). Fields that it does not know are found by job.schema.json.
const fs = require("fs");
const yaml = require("js-yaml");
const { Job } = require("kubernetes-models/batch/v1/Job");

let failed = 0;
function judge(name, document) {
  try {
    if (document.apiVersion !== "batch/v1" || document.kind !== "Job") throw new Error(`${document.apiVersion} ${document.kind} is not a Job`);
    new Job(document).validate();
    console.log(`ok   ${name}: ${document.metadata.name}`);
  } catch (error) {
    failed = 1;
    console.log(`FAIL ${name}: ${error.message}`);
  }
}
for (const name of process.argv.slice(2)) yaml.loadAll(fs.readFileSync(name, "utf8")).forEach((document) => judge(name, document));
process.exit(failed);
